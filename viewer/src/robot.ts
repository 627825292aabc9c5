/** The robot on the canvas: its body and heading, what it senses, and what it does, as a row has them. */

import type { Column, Robot } from "./protocol";
import { type Row, valueAt } from "./rows";
import type { Theme } from "./theme";

const LIT_COMMAND = 0.5; // of a lamp: above it, it throws a beam
const BEAM_SIDES = 5; // how many sides of its robot a beam is long
const JET_SIDES = 1.6;
const BEARING_PIXELS = 14;

/** Draws it in the coordinates of the world; `pixel` is how many units a pixel has. */
export function drawRobot(
  context: CanvasRenderingContext2D,
  robot: Robot,
  row: Row,
  [x, y, angle]: [number, number, number],
  theme: Theme,
  pixel: number,
): void {
  context.save();
  context.translate(x, y);
  context.rotate(angle);
  const pen: Pen = { context, robot, row, theme, pixel };
  if (row.tick > 0) {
    rays(pen);
    lamps(pen);
    jets(pen);
    claw(pen);
  }
  body(context, robot, theme.robot, theme, pixel);
  wheels(pen);
  if (row.tick > 0) {
    bearings(pen);
    switches(pen);
    spots(pen);
  }
  context.restore();
}

interface Pen {
  context: CanvasRenderingContext2D;
  robot: Robot;
  row: Row;
  theme: Theme;
  pixel: number;
}

function line(context: CanvasRenderingContext2D, points: number[][], width: number, colour: string): void {
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.lineWidth = width;
  context.strokeStyle = colour;
  context.stroke();
}

function disc(context: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
}

/** Each ray as far as it went; how far one saw that looks for a single name is not known where it saw nothing. */
function rays({ context, robot, row, theme, pixel }: Pen): void {
  const before = context.globalAlpha;
  for (const ray of robot.rays) {
    const { reach, sees } = ray;
    const reading = valueAt(row, ray.column);
    const angle = ray.angle + turnOf(row, ray.turned);
    if (!Number.isFinite(reading + angle) || (sees && reading === 1)) continue;
    const way = [Math.cos(angle), Math.sin(angle)];
    const rim = ray.turned && robot.outline.length ? rimAlong(robot, way) : ray.rim;
    const far = rim + reading * reach;
    context.globalAlpha = before * (reading < 1 ? 0.75 : 0.28);
    line(context, [way.map((part) => part * rim), way.map((part) => part * far)], pixel, theme.ray);
    if (reading < 1) disc(context, way[0] * far, way[1] * far, 2.5 * pixel, theme.ray);
  }
  context.globalAlpha = before;
}

/** The angle to the left by which a servo has turned, as the reading in a column says; 0 without one. */
function turnOf(row: Row, column: Column | null): number {
  return column ? 2 * Math.PI * (0.5 - valueAt(row, column)) : 0;
}

/** The distance from the middle of a rectangular body to its rim in a direction. */
function rimAlong(robot: Robot, [ahead, aside]: number[]): number {
  return 1 / Math.max(Math.abs(ahead) / robot.front, Math.abs(aside) / robot.side);
}

/** Draws another one where it is, so many times as large: of what it senses and does nothing is known here. */
export function drawOther(
  context: CanvasRenderingContext2D,
  robot: Robot,
  [x, y, angle]: [number, number, number],
  larger: number,
  colour: string,
  theme: Theme,
  pixel: number,
): void {
  context.save();
  context.translate(x, y);
  context.rotate(angle);
  context.scale(larger, larger);
  body(context, robot, colour, theme, pixel / larger);
  context.restore();
}

function body(context: CanvasRenderingContext2D, robot: Robot, colour: string, theme: Theme, pixel: number): void {
  context.beginPath();
  if (robot.outline.length) {
    for (const [x, y] of robot.outline) context.lineTo(x, y);
    context.closePath();
  } else context.arc(0, 0, robot.radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
  context.lineWidth = 1.2 * pixel;
  context.strokeStyle = theme.floor;
  context.stroke();
  line(context, [[0, 0], [0.95 * robot.front, 0]], Math.max(2 * pixel, 0.12 * robot.side), theme.floor);
}

function wheels({ context, robot, row, theme, pixel }: Pen): void {
  if (!robot.axles) return;
  const turned = robot.steering ? (1 - 2 * valueAt(row, robot.steering.column)) * robot.steering.turn : 0;
  for (const [ahead, turn] of [[-0.5, 0], [0.5, row.tick > 0 ? turned : 0]]) {
    for (const aside of [robot.side, -robot.side]) {
      context.save();
      context.translate(ahead * robot.axles, aside);
      context.rotate(turn);
      context.fillStyle = theme.robot;
      context.strokeStyle = theme.floor;
      context.lineWidth = pixel;
      const [long, wide] = [0.32 * robot.front, 0.14 * robot.front];
      context.fillRect(-long, -wide, 2 * long, 2 * wide);
      context.strokeRect(-long, -wide, 2 * long, 2 * wide);
      context.restore();
    }
  }
}

/** A small arrow outside the body in the direction in which each bearing points: 0.5 is ahead, 0.25 to the left. */
function bearings({ context, robot, row, theme, pixel }: Pen): void {
  for (const { column, turned } of robot.bearings) {
    const angle = turnOf(row, column) + turnOf(row, turned);
    if (!Number.isFinite(angle)) continue;
    const from = robot.front + 3 * pixel;
    context.save();
    context.rotate(angle);
    line(context, [[from, -4 * pixel], [from + 0.4 * BEARING_PIXELS * pixel, 0], [from, 4 * pixel]], 2 * pixel, theme.lamp);
    context.restore();
  }
}

function claw({ context, robot, row, theme, pixel }: Pen): void {
  if (!robot.claw) return;
  const apart = valueAt(row, robot.claw) > 0.5 ? 0.35 : 0.75;
  for (const side of [-robot.side, robot.side]) {
    const at = (ahead: number, aside: number) => [robot.front + ahead * robot.side, aside * side];
    line(context, [at(-0.2, 0.5), at(0.4, apart), at(0.9, 0.8 * apart)], Math.max(2 * pixel, 0.12 * robot.side), theme.robot);
  }
}

function lamps({ context, robot, row, theme }: Pen): void {
  const before = context.globalAlpha;
  robot.lamps.forEach((column, place) => {
    const bright = valueAt(row, column);
    const size = (0.7 * robot.side) / (2 + robot.lamps.length);
    const [ahead, aside] = [0.6 * robot.front, ((robot.lamps.length - 1) / 2 - place) * 2.4 * size];
    if (bright > LIT_COMMAND) {
      const far = BEAM_SIDES * robot.side;
      context.globalAlpha = before * 0.35 * bright;
      context.beginPath();
      context.moveTo(ahead, aside);
      context.lineTo(ahead + far, aside - 0.4 * far);
      context.lineTo(ahead + far, aside + 0.4 * far);
      context.fillStyle = theme.lamp;
      context.fill();
    }
    context.globalAlpha = before * (0.2 + 0.8 * bright);
    disc(context, robot.front + size, aside, size, theme.lamp);
  });
  context.globalAlpha = before;
}

function jets({ context, robot, row, theme, pixel }: Pen): void {
  for (const { at, way, column } of robot.jets) {
    const force = 2 * valueAt(row, column) - 1;
    const end = at.map((part, place) => part - JET_SIDES * robot.side * force * way[place]);
    line(context, [at, end], 4 * pixel, theme.lamp);
  }
}

/** The switches of a bumper along the rim, red where they are pressed. */
function switches({ context, robot, row, theme, pixel }: Pen): void {
  for (const { angle, width, column } of robot.switches) {
    if (!Number.isFinite(valueAt(row, column))) continue;
    context.beginPath();
    context.arc(0, 0, robot.radius || robot.front, angle - width / 2, angle + width / 2);
    context.lineWidth = 3 * pixel;
    context.strokeStyle = valueAt(row, column) > 0.5 ? theme.crash : theme.faint;
    context.stroke();
  }
}

/** The points of the floor that a sensor looks down at, filled where it sees what it looks for. */
function spots({ context, robot, row, theme, pixel }: Pen): void {
  for (const { x, y, column } of robot.spots) {
    if (!Number.isFinite(valueAt(row, column))) continue;
    disc(context, x, y, 3.6 * pixel, theme.ray);
    if (valueAt(row, column) <= 0.5) disc(context, x, y, 2.4 * pixel, theme.floor);
  }
}
