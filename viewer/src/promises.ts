/** What skills promise: in words, and as marks in their boxes. */

import { shown } from "./names";
import type { Promised } from "./protocol";
import { type Row, valueAt } from "./rows";
import { make } from "./svg";

const VERDICTS = ["not judged", "held", "broken by it", "broken above it"]; // in a tick
const PROMISE_CHARACTERS = 120;
const MARK_PIXELS = 4;
const GAP_PIXELS = 11;
const SIDE_PIXELS = 9; // free on both sides of a box

/** What became of a promise in a tick and before, in a line. */
export function inWords({ text, columns }: Promised, row: Row): string {
  const [now, held, bySkill, byAbove] = columns.map((column) => valueAt(row, column));
  const judged = held + bySkill + byAbove;
  const broken = [bySkill && `by it in ${bySkill}`, byAbove && `above it in ${byAbove}`].filter(Boolean).join(", ");
  const soFar = broken ? `so far broken ${broken} of ${judged} ticks` : `never broken in ${judged} tick${judged === 1 ? "" : "s"}`;
  return `${shown(text, PROMISE_CHARACTERS)}: ${judged ? `${VERDICTS[now]}; ${soFar}` : "not judged yet"}`;
}

/** A mark for each promise, from the left on at the bottom of a box. */
export function marks(promises: Promised[], width: number, height: number): SVGElement[] {
  const gap = Math.min(GAP_PIXELS, (width - 2 * SIDE_PIXELS) / promises.length);
  return promises.map((_, place) => make("circle", { class: "promise", cx: SIDE_PIXELS + place * gap, cy: height, r: MARK_PIXELS }));
}

/** Lights marks as a row has them; those of promises that were broken before stay rings. */
export function light(marks: SVGElement[], promises: Promised[], row: Row): void {
  promises.forEach(({ columns }, place) => {
    const [now, , bySkill, byAbove] = columns.map((column) => valueAt(row, column));
    const state = `promise${now === 1 ? " held" : now > 1 ? " broken" : ""}${bySkill + byAbove > 0 ? " before" : ""}`;
    if (marks[place].getAttribute("class") !== state) marks[place].setAttribute("class", state);
  });
}
