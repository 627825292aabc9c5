/** The world on a canvas: arena, obstacles, things, the path behind the robot, and where it collided. */

import { Camera } from "./camera";
import type { Events } from "./events";
import { drawFloor, WALL_UNITS } from "./floor";
import { shown } from "./names";
import { type About, columnOf, type Column, type Thing, type World as WorldData } from "./protocol";
import type { Beside } from "./forks";
import { drawOther, drawRobot } from "./robot";
import { type Row, type Rows, valueAt } from "./rows";
import type { Theme } from "./theme";

const MARGIN = { above: 38, below: 4 };
const PATH_TICKS = 1500;
const PATH_PARTS = 30; // each a little darker than the one before
const COLLISION_MARKS = 60;
const FREE_VIEW_UNITS = 60; // what is seen where there are no walls
const NAME_PIXELS = 14;
const THING_PIXELS_MIN = 7; // smaller ones are drawn as large
const ROBOT_PIXELS_MIN = 6; // of its radius: a smaller one has a ring around it, and others are drawn as large
const RING_PIXELS = 13;
const THING_COLUMNS = 4; // x, y, size, turned
const CLICK_PIXELS = 12; // so near to the middle of another robot it is meant

export class World {
  private readonly camera: Camera;
  private readonly context: CanvasRenderingContext2D;
  private readonly held: Column | null;
  private follows = false;
  private row: Row | undefined; // that is drawn

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly about: About,
    private readonly world: WorldData,
    private theme: Theme,
    changed: () => void,
    watch: (robot: number) => void,
  ) {
    this.context = canvas.getContext("2d")!;
    this.held = columnOf(about, "held");
    this.camera = new Camera(canvas, MARGIN, changed);
    canvas.addEventListener("dblclick", () => this.fit());
    canvas.addEventListener("pointermove", (event) => {
      canvas.style.cursor = this.robotAt(event) === null ? "" : "pointer";
    });
    canvas.addEventListener("click", (event) => {
      const robot = this.camera.dragged ? null : this.robotAt(event);
      if (robot !== null) watch(robot);
    });
    this.follows = world.arena === null;
  }

  recolour(theme: Theme): void {
    this.theme = theme;
  }

  /** Shows the whole arena, or what is around the robot where there is none. */
  fit(): void {
    const [x, y] = this.world.arena ?? [FREE_VIEW_UNITS / 2, FREE_VIEW_UNITS / 2];
    const margin = WALL_UNITS + 0.02 * x;
    this.follows = this.world.arena === null;
    this.camera.fit(-x - margin, -y - margin, 2 * (x + margin), 2 * (y + margin));
  }

  zoom(factor: number): void {
    this.camera.zoom(factor);
  }

  /** Stays with the robot, or no more; whether it does so now. */
  follow(): boolean {
    this.follows = !this.follows;
    return this.follows;
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.canvas.width = clientWidth * devicePixelRatio;
    this.canvas.height = clientHeight * devicePixelRatio;
    if (!this.camera.touched) this.fit();
  }

  /** Draws what was after a tick, and where the robot of a run beside this one was. */
  draw(row: Row, rows: Rows, collisions: Events, beside?: Beside): void {
    const { context, canvas, camera, theme } = this;
    const [x, y] = this.pose(row);
    this.row = row;
    if (this.follows) {
      camera.x = canvas.clientWidth / 2 - x * camera.scale;
      camera.y = canvas.clientHeight / 2 + y * camera.scale;
    }
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.fillStyle = this.world.arena ? theme.page : theme.floor;
    context.fillRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    context.translate(camera.x, camera.y);
    context.scale(camera.scale, -camera.scale); // y points up
    context.lineJoin = context.lineCap = "round";
    drawFloor(context, this.world, camera, theme);
    this.things(row, true);
    if (beside) this.path(row.tick, beside.rows, theme.lamp, beside.from);
    this.path(row.tick, rows, theme.late);
    this.collisions(rows, collisions, row.tick);
    this.things(row, false);
    const other = beside?.rows.row(row.tick);
    if (other) this.ghost(other);
    drawRobot(context, this.world.robot, row, this.pose(row), theme, 1 / camera.scale);
    this.ring(x, y);
    this.names(row);
  }

  private pose(row: Row): [number, number, number] {
    const first = this.about.columns.robot?.[1] ?? 0;
    return [row.doubles[first], row.doubles[first + 1], row.doubles[first + 2]];
  }

  /** The other robot that is drawn there, by its number. */
  private robotAt({ offsetX, offsetY }: MouseEvent): number | null {
    const { camera, row } = this;
    let [found, nearest]: [number | null, number] = [null, Math.max(CLICK_PIXELS, this.world.robot.radius * camera.scale)];
    for (const [thing, [x, y]] of row ? this.eachThing(row) : []) {
      const far = Math.hypot(camera.x + x * camera.scale - offsetX, camera.y - y * camera.scale - offsetY);
      if (thing.robot !== null && far <= nearest) [found, nearest] = [thing.robot, far];
    }
    return found;
  }

  private *eachThing(row: Row): Iterable<[Thing, number[], boolean]> {
    const first = this.about.columns.things?.[1] ?? 0;
    const held = valueAt(row, this.held);
    for (const [number, thing] of this.world.things.entries()) {
      const at = first + THING_COLUMNS * number;
      const place = [...row.doubles.subarray(at, at + THING_COLUMNS)];
      if (Number.isFinite(place[0])) yield [thing, place, held === number];
    }
  }

  private colour(thing: Thing): string {
    return document.documentElement.dataset.theme === "dark" ? thing.dark : thing.light;
  }

  private things(row: Row, areas: boolean): void {
    const { context, theme, camera } = this;
    for (const [thing, [x, y, width, turned], isHeld] of this.eachThing(row)) {
      if ((thing.shape === "area") !== areas) continue;
      if (thing.robot !== null) {
        const larger = Math.max(1, ROBOT_PIXELS_MIN / (this.world.robot.radius * camera.scale));
        drawOther(context, this.world.robot, [x, y, turned || 0], larger, this.colour(thing), theme, 1 / camera.scale);
        continue;
      }
      const size = Math.max(width, THING_PIXELS_MIN / camera.scale);
      context.save();
      context.translate(x, y);
      context.beginPath();
      if (thing.shape === "disc") context.arc(0, 0, size / 2, 0, 2 * Math.PI);
      else {
        if (!areas) context.rotate(turned || 0);
        context.rect(-size / 2, -size / 2, size, size);
      }
      context.fillStyle = context.strokeStyle = this.colour(thing);
      context.globalAlpha = areas ? 0.22 : 1;
      context.fill();
      context.globalAlpha = 1;
      if (!areas) context.strokeStyle = isHeld ? theme.lamp : theme.floor;
      context.lineWidth = (isHeld ? 3 : 1.5) / camera.scale;
      context.stroke();
      context.restore();
    }
  }

  private path(tick: number, rows: Rows, colour: string, from = 0): void {
    const { context, camera } = this;
    const points = rows.track.between(Math.max(from, tick - PATH_TICKS), tick);
    const step = Math.ceil(points.length / PATH_PARTS) || 1;
    context.strokeStyle = colour;
    context.lineWidth = 2 / camera.scale;
    context.lineCap = "butt"; // the parts would be seen twice where they meet
    for (let first = 0; first < points.length - 1; first += step) {
      context.beginPath();
      context.moveTo(points[first][0], points[first][1]);
      for (const [x, y] of points.slice(first + 1, first + step + 1)) context.lineTo(x, y);
      context.globalAlpha = 0.08 + (0.72 * (first + step)) / points.length;
      context.stroke();
    }
    context.globalAlpha = 1;
    context.lineCap = "round";
  }

  private collisions(rows: Rows, collisions: Events, until: number): void {
    const { context, theme, camera } = this;
    const arm = 5 / camera.scale;
    context.strokeStyle = theme.crash;
    context.lineWidth = 2 / camera.scale;
    context.beginPath();
    const last = collisions.before(until + 1);
    for (const { tick } of collisions.all.slice(Math.max(0, last - COLLISION_MARKS), last)) {
      const found = rows.track.at(tick);
      if (!found) continue;
      const [x, y] = found;
      context.moveTo(x - arm, y - arm);
      context.lineTo(x + arm, y + arm);
      context.moveTo(x - arm, y + arm);
      context.lineTo(x + arm, y - arm);
    }
    context.stroke();
  }

  /** Where a robot is that is too small to be found. */
  private ring(x: number, y: number): void {
    const { context, camera, theme } = this;
    if (this.world.robot.radius * camera.scale > ROBOT_PIXELS_MIN) return;
    context.beginPath();
    context.arc(x, y, RING_PIXELS / camera.scale, 0, 2 * Math.PI);
    context.strokeStyle = theme.late;
    context.lineWidth = 1.5 / camera.scale;
    context.stroke();
  }

  private ghost(row: Row): void {
    const { context } = this;
    context.globalAlpha = 0.35;
    drawRobot(context, { ...this.world.robot, rays: [] }, row, this.pose(row), this.theme, 1 / this.camera.scale);
    context.globalAlpha = 1;
  }

  private names(row: Row): void {
    const { context, camera, theme } = this;
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    context.lineWidth = 3;
    const taken: [left: number, top: number, half: number][] = []; // no name is written over another
    for (const [thing, [x, y, size], isHeld] of this.eachThing(row)) {
      const name = thing.robot === null ? shown(thing.name, 24) : `robot ${thing.robot}`;
      const text = isHeld ? `${name} (held)` : name;
      const left = camera.x + x * camera.scale;
      const top = camera.y - (y + size / 2) * camera.scale - 6;
      const half = context.measureText(text).width / 2;
      if (taken.some((one) => Math.abs(one[0] - left) < one[2] + half && Math.abs(one[1] - top) < NAME_PIXELS)) continue;
      taken.push([left, top, half]);
      context.strokeStyle = theme.floor;
      context.strokeText(text, left, top);
      context.fillStyle = theme.ink;
      context.fillText(text, left, top);
    }
  }
}
