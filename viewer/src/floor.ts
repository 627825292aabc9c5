/** The floor of the world on a canvas: its walls, a grid, and obstacles, in the coordinates of the world. */

import type { Camera } from "./camera";
import type { World } from "./protocol";
import type { Theme } from "./theme";

const GRID_UNITS = 10;
export const WALL_UNITS = 0.8;

export function drawFloor(context: CanvasRenderingContext2D, world: World, camera: Camera, theme: Theme): void {
  const { arena, boxes, doors } = world; // of what may open the rim alone is drawn
  if (arena) {
    const [x, y] = arena;
    context.fillStyle = theme.wall;
    context.fillRect(-x - WALL_UNITS, -y - WALL_UNITS, 2 * (x + WALL_UNITS), 2 * (y + WALL_UNITS));
    context.fillStyle = theme.floor;
    context.fillRect(-x, -y, 2 * x, 2 * y);
  }
  drawGrid(context, arena, camera, theme);
  context.fillStyle = theme.rock;
  context.strokeStyle = theme.rockEdge;
  context.lineWidth = 1.2 / camera.scale;
  for (const [number, [x, y, halfX, halfY]] of boxes.entries()) {
    if (!doors.includes(number)) context.fillRect(x - halfX, y - halfY, 2 * halfX, 2 * halfY);
    context.strokeRect(x - halfX, y - halfY, 2 * halfX, 2 * halfY);
  }
}

function drawGrid(context: CanvasRenderingContext2D, arena: World["arena"], camera: Camera, theme: Theme): void {
  const { clientWidth, clientHeight } = context.canvas;
  const left = arena ? -arena[0] : -camera.x / camera.scale;
  const right = arena ? arena[0] : (clientWidth - camera.x) / camera.scale;
  const high = arena ? arena[1] : camera.y / camera.scale;
  const low = arena ? -arena[1] : (camera.y - clientHeight) / camera.scale;
  const apart = GRID_UNITS * Math.max(1, 10 ** Math.ceil(Math.log10(1 / camera.scale)));
  context.beginPath();
  for (let x = Math.ceil(left / apart) * apart; x <= right; x += apart) {
    context.moveTo(x, low);
    context.lineTo(x, high);
  }
  for (let y = Math.ceil(low / apart) * apart; y <= high; y += apart) {
    context.moveTo(left, y);
    context.lineTo(right, y);
  }
  context.strokeStyle = theme.grid;
  context.lineWidth = 1 / camera.scale;
  context.stroke();
}
