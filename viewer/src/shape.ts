/** What two runs have in common that can be shown in the same page one after the other. */

import type { About } from "./protocol";

export function shapeOf(about: About): string {
  const { title, seed, robot, edits, training, world, links, ...shape } = about;
  return JSON.stringify({ ...shape, world: world && { ...world, boxes: null } });
}
