/** The whole run as a strip: what is known of it, what happened when, and which tick is shown; clicked and dragged. */

import { shown } from "./names";
import type { About } from "./protocol";
import type { Theme } from "./theme";

const EVENT_PIXELS = 4; // so near to the pointer an event is meant
const TRACK_PIXELS = 6;
const MARK_PIXELS = 14;
const ALARMS = ["collision", "fault", "stopped", "touch"];

export interface Happened {
  tick: number;
  event: number;
}

export class Timeline {
  private readonly context: CanvasRenderingContext2D;
  private happened: Happened[] = [];
  private tick = 0;
  private known = 0;
  private over = false;
  private dragging = false;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly hint: HTMLElement,
    private readonly about: About,
    private theme: Theme,
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
    this.draw();
  }

  /** Draws it anew where something has changed. */
  show(tick: number, known: number, over: boolean, happened: Happened[]): void {
    const same = tick === this.tick && known === this.known && over === this.over;
    if (same && happened.length === this.happened.length) return;
    this.tick = tick;
    this.over = over;
    this.known = known;
    this.happened = [...happened];
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

  /** The event after a tick, or before it. */
  next(from: number, direction: 1 | -1): Happened | undefined {
    const found = this.happened.filter(({ tick }) => (tick - from) * direction > 0);
    return direction > 0 ? found[0] : found[found.length - 1];
  }

  private get length(): number {
    const goesOn = this.about.source === "simulation" && !this.over;
    return Math.max(1, this.known, goesOn ? (this.about.of_ticks ?? 0) : 0);
  }

  private x(tick: number): number {
    return (tick / this.length) * this.canvas.clientWidth;
  }

  private tickAt(event: PointerEvent): number {
    const { left, width } = this.canvas.getBoundingClientRect();
    return Math.round(((event.clientX - left) / width) * this.length);
  }

  private nearest(event: PointerEvent): Happened | undefined {
    const { left } = this.canvas.getBoundingClientRect();
    const apart = (one: Happened) => Math.abs(this.x(one.tick) - (event.clientX - left));
    const near = this.happened.filter((one) => apart(one) <= EVENT_PIXELS);
    return near.sort((one, other) => apart(one) - apart(other))[0];
  }

  private say(event: PointerEvent): void {
    const near = this.nearest(event);
    const tick = near?.tick ?? this.tickAt(event);
    const text = near ? `${shown(this.about.events[near.event]?.text ?? "event")}, ` : "";
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
      context.roundRect(0, middle - TRACK_PIXELS / 2, Math.max(1, right), TRACK_PIXELS, TRACK_PIXELS / 2);
      context.fill();
    };
    bar(width, theme.grid);
    bar(this.x(this.known), theme.rock);
    bar(this.x(this.tick), theme.late);
    for (const { tick, event } of this.happened) {
      context.fillStyle = this.colour(this.about.events[event]?.kind ?? "");
      context.fillRect(Math.round(this.x(tick)) - 1, middle - MARK_PIXELS / 2, 2, MARK_PIXELS);
    }
    context.beginPath();
    context.arc(Math.min(width - 7, Math.max(7, this.x(this.tick))), middle, 7, 0, 2 * Math.PI);
    context.fillStyle = theme.late;
    context.strokeStyle = theme.page;
    context.lineWidth = 2;
    context.fill();
    context.stroke();
  }

  private colour(kind: string): string {
    if (ALARMS.includes(kind)) return this.theme.crash;
    return kind === "delivery" ? this.theme.glow : this.theme.lamp;
  }
}
