/** What part of a drawing is seen: dragged, turned in by the wheel, or pinched; it stays until somebody moves it. */

export const ZOOM_MIN = 0.02;
export const ZOOM_MAX = 400;
const WHEEL_ZOOM = 0.0015; // per pixel of the wheel
const DRAG_PIXELS = 4; // less is a click

export class Camera {
  scale = 1; // pixels per unit
  x = 0; // pixels, where the drawing's origin is
  y = 0;
  touched = false;
  private readonly fingers = new Map<number, { x: number; y: number }>();
  private travelled = 0;

  constructor(
    private readonly element: HTMLElement | SVGElement,
    private readonly margin: { above: number; below: number }, // pixels, for titles and buttons
    private readonly changed: () => void,
  ) {
    element.addEventListener("wheel", (event) => this.wheel(event as WheelEvent), { passive: false });
    element.addEventListener("pointerdown", (event) => this.down(event as PointerEvent));
    element.addEventListener("pointermove", (event) => this.move(event as PointerEvent));
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) {
      element.addEventListener(end, (event) => this.fingers.delete((event as PointerEvent).pointerId));
    }
  }

  /** Whether the pointer was dragged since it went down: then what follows is no click. */
  get dragged(): boolean {
    return this.travelled > DRAG_PIXELS;
  }

  /** Shows a rectangle of the drawing as large as it fits between what stands above it and below. */
  fit(left: number, top: number, width: number, height: number, largest = ZOOM_MAX): void {
    const { clientWidth, clientHeight } = this.element;
    const { above, below } = this.margin;
    const free = Math.max(1, clientHeight - above - below);
    this.scale = Math.min(largest, clientWidth / width, free / height) || 1;
    this.x = clientWidth / 2 - (left + width / 2) * this.scale;
    this.y = above + free / 2 - (top + height / 2) * this.scale;
    this.touched = false;
    this.changed();
  }

  zoom(factor: number, x = this.element.clientWidth / 2, y = this.element.clientHeight / 2): void {
    const scale = Math.min(ZOOM_MAX, Math.max(ZOOM_MIN, this.scale * factor));
    this.x = x - ((x - this.x) * scale) / this.scale;
    this.y = y - ((y - this.y) * scale) / this.scale;
    this.scale = scale;
    this.touched = true;
    this.changed();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { left, top } = this.element.getBoundingClientRect();
    this.zoom(Math.exp(-event.deltaY * WHEEL_ZOOM), event.clientX - left, event.clientY - top);
  }

  private down(event: PointerEvent): void {
    this.travelled = 0;
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  private move(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    this.travelled += Math.hypot(now.x - before.x, now.y - before.y);
    this.fingers.set(event.pointerId, now);
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const { left, top } = this.element.getBoundingClientRect();
      const apart = Math.hypot(now.x - other.x, now.y - other.y);
      const were = Math.hypot(before.x - other.x, before.y - other.y) || 1;
      this.zoom(apart / were, (now.x + other.x) / 2 - left, (now.y + other.y) / 2 - top);
    } else if (this.dragged) {
      this.x += now.x - before.x;
      this.y += now.y - before.y;
      this.touched = true;
      this.changed();
    }
  }
}
