/** Edges on a canvas below the nodes: so many that as elements they would take too long to draw. */

import type { Camera } from "./camera";

type Line = { x: number; y: number }[];
const LEVELS = 8; // so many widths: edges of one are drawn at once
const EDGE_PIXELS_MAX = 7;
const NEAR_PIXELS = 6;

export class EdgeCanvas {
  private readonly context: CanvasRenderingContext2D;
  private lines = new Map<number, Line>();
  private values = new Map<number, number>();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly camera: Camera,
  ) {
    this.context = canvas.getContext("2d")!;
  }

  /** Takes the place of all edges there were; they are straight here. */
  set(lines: Map<number, Line>): void {
    this.lines = new Map([...lines].map(([edge, line]) => [edge, [line[0], line[line.length - 1]]]));
    this.values = new Map();
    this.draw();
  }

  /** What an edge transmits; nothing is drawn before `draw`. */
  light(edge: number, value: number): void {
    this.values.set(edge, value);
  }

  draw(): void {
    const { canvas, context, camera } = this;
    const { clientWidth, clientHeight } = canvas;
    if (canvas.width !== clientWidth * devicePixelRatio) canvas.width = clientWidth * devicePixelRatio;
    if (canvas.height !== clientHeight * devicePixelRatio) canvas.height = clientHeight * devicePixelRatio;
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, clientWidth, clientHeight);
    if (!this.lines.size) return;
    context.transform(camera.scale, 0, 0, camera.scale, camera.x, camera.y);
    context.strokeStyle = getComputedStyle(canvas).getPropertyValue("--glow");
    const levels: Line[][] = Array.from({ length: LEVELS + 1 }, () => []);
    for (const [edge, line] of this.lines) {
      const value = this.values.get(edge) ?? 0;
      if (value > 0) levels[Math.ceil(Math.min(1, value) * LEVELS)].push(line);
    }
    levels.forEach((of, level) => this.stroke(of, level / LEVELS));
    context.globalAlpha = 1;
  }

  /** The edge that is nearest to a place of the screen, if one is near. */
  at(x: number, y: number): number | null {
    const { camera } = this;
    const [left, top] = [(x - camera.x) / camera.scale, (y - camera.y) / camera.scale];
    let [found, nearest]: [number | null, number] = [null, NEAR_PIXELS / camera.scale];
    for (const [edge, [from, to]] of this.lines) {
      const apart = distance(left, top, from, to);
      if (apart < nearest && this.values.get(edge)) [found, nearest] = [edge, apart];
    }
    return found;
  }

  private stroke(lines: Line[], share: number): void {
    if (!lines.length) return;
    const { context } = this;
    context.beginPath();
    for (const [from, to] of lines) {
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
    }
    context.globalAlpha = 0.15 + 0.6 * share;
    context.lineWidth = Math.max(0.5 / this.camera.scale, EDGE_PIXELS_MAX * share);
    context.stroke();
  }
}

/** From a point to a stretch of a line. */
function distance(x: number, y: number, from: { x: number; y: number }, to: { x: number; y: number }): number {
  const [wide, high] = [to.x - from.x, to.y - from.y];
  const along = ((x - from.x) * wide + (y - from.y) * high) / (wide * wide + high * high || 1);
  const share = Math.min(1, Math.max(0, along));
  return Math.hypot(x - from.x - share * wide, y - from.y - share * high);
}
