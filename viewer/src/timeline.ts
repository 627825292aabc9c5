/** The whole run as a strip: what is known of it, what happened when, and which tick is shown; clicked and dragged. */

import type { Events, Happened } from "./events";
import { shown } from "./names";
import type { About } from "./protocol";
import type { Stops } from "./stops";
import type { Theme } from "./theme";

const EVENT_PIXELS = 4; // so near to the pointer an event is meant
const TRACK_PIXELS = 6;
const MARK_PIXELS = 14;
const EDGE_PIXELS = 8; // on both sides, so that nothing at an end is cut
const ALARMS = ["broken", "collision", "fault", "stopped", "touch"];

export class Timeline {
  private readonly context: CanvasRenderingContext2D;
  private marked = ""; // for what the marks were found
  private marks = new Map<number, string>(); // at each pixel the one kind that is seen
  private tick = 0;
  private known = 0;
  private over = false;
  private dragging = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly hint: HTMLElement,
    private readonly about: About,
    private theme: Theme,
    private readonly happened: Events,
    private readonly stops: Stops,
    private readonly jump: (tick: number) => void,
  ) {
    this.context = canvas.getContext("2d")!;
    canvas.addEventListener("pointerdown", (event) => {
      this.dragging = true;
      canvas.setPointerCapture(event.pointerId);
      this.jump(this.nearest(event)?.tick ?? this.tickAt(event));
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragging) this.jump(this.tickAt(event));
      this.say(event);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => (this.dragging = false));
    canvas.addEventListener("pointerleave", () => (this.hint.hidden = true));
  }

  recolour(theme: Theme): void {
    this.theme = theme;
    this.marked = "";
    this.draw();
  }

  /** Draws it anew where something has changed. */
  show(tick: number, known: number, over: boolean): void {
    if (tick === this.tick && known === this.known && over === this.over && this.marked === this.wanted) return;
    this.tick = tick;
    this.over = over;
    this.known = known;
    this.canvas.setAttribute("aria-valuemax", String(known));
    this.canvas.setAttribute("aria-valuenow", String(tick));
    this.canvas.setAttribute("aria-valuetext", `tick ${tick} of ${known}, ${(tick * this.about.tick).toFixed(2)} seconds`);
    this.draw();
  }

  resize(): void {
    this.canvas.width = this.canvas.clientWidth * devicePixelRatio;
    this.canvas.height = this.canvas.clientHeight * devicePixelRatio;
    this.draw();
  }

  /** The event or the breakpoint after a tick, or before it. */
  next(from: number, direction: 1 | -1): Happened | undefined {
    return this.closest(from, (each) => each.next(from, direction));
  }

  private get length(): number {
    const goesOn = this.about.source === "simulation" && !this.over;
    return Math.max(1, this.known, goesOn ? (this.about.of_ticks ?? 0) : 0);
  }

  private x(tick: number): number {
    return EDGE_PIXELS + (tick / this.length) * (this.canvas.clientWidth - 2 * EDGE_PIXELS);
  }

  private tickAt(event: PointerEvent): number {
    const { left, width } = this.canvas.getBoundingClientRect();
    const part = (event.clientX - left - EDGE_PIXELS) / (width - 2 * EDGE_PIXELS);
    return Math.round(Math.min(1, Math.max(0, part)) * this.length);
  }

  private nearest(event: PointerEvent): Happened | undefined {
    const tick = this.tickAt(event);
    return this.closest(tick, (each) => each.nearest(tick, (EVENT_PIXELS * this.length) / this.canvas.clientWidth));
  }

  private closest(tick: number, found: (each: Events) => Happened | undefined): Happened | undefined {
    const both = [found(this.stops.events), found(this.happened)].filter((one) => one !== undefined);
    return both.sort((one, other) => Math.abs(one.tick - tick) - Math.abs(other.tick - tick))[0];
  }

  private say(event: PointerEvent): void {
    const near = this.nearest(event);
    const tick = near?.tick ?? this.tickAt(event);
    const text = near ? `${this.stops.at(tick) ?? shown(this.about.events[near.event]?.text ?? "event")}, ` : "";
    this.hint.hidden = false;
    this.hint.textContent = `${text}tick ${tick}, ${(tick * this.about.tick).toFixed(2)} s`;
    const { left, width } = this.canvas.getBoundingClientRect();
    const half = this.hint.clientWidth / 2;
    this.hint.style.left = `${Math.min(Math.max(event.clientX - left, half), width - half)}px`;
  }

  private draw(): void {
    const { context, canvas, theme } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    const middle = height / 2;
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, width, height);
    const bar = (right: number, colour: string) => {
      context.fillStyle = colour;
      context.beginPath();
      context.roundRect(EDGE_PIXELS, middle - TRACK_PIXELS / 2, Math.max(1, right - EDGE_PIXELS), TRACK_PIXELS, TRACK_PIXELS / 2);
      context.fill();
    };
    bar(width - EDGE_PIXELS, theme.grid);
    bar(this.x(this.known), theme.rock);
    bar(this.x(this.tick), theme.late);
    this.mark();
    for (const [x, colour] of this.marks) {
      context.fillStyle = colour;
      context.fillRect(x - 1, middle - MARK_PIXELS / 2, 2, MARK_PIXELS);
    }
    context.beginPath();
    context.arc(this.x(this.tick), middle, 7, 0, 2 * Math.PI);
    context.fillStyle = theme.late;
    context.strokeStyle = theme.page;
    context.lineWidth = 2;
    context.fill();
    context.stroke();
  }

  /** What the marks depend on. */
  private get wanted(): string {
    return [this.happened.length, this.stops.events.length, this.length, this.canvas.clientWidth].join();
  }

  /** Finds the marks where they are others now: of several at one pixel a breakpoint is seen, or else an alarm, a delivery. */
  private mark(): void {
    if (this.marked === this.wanted) return;
    this.marked = this.wanted;
    this.marks = new Map();
    const { crash, glow, ink, lamp } = this.theme;
    const ranks = [lamp, glow, crash, ink];
    const kinds = this.about.events.map(({ kind }) => (ALARMS.includes(kind) ? 2 : kind === "delivery" ? 1 : 0));
    const seen = new Int8Array(this.canvas.clientWidth + 1).fill(-1);
    for (const { tick, event } of this.happened.all) {
      const x = Math.round(this.x(tick));
      seen[x] = Math.max(seen[x], kinds[event] ?? 0);
    }
    for (const { tick } of this.stops.events.all) seen[Math.round(this.x(tick))] = ranks.length - 1;
    seen.forEach((rank, x) => rank >= 0 && this.marks.set(x, ranks[rank]));
  }
}
