/** Where the robot was: its poses alone, which come faster than whole rows. */

import { type About, type Column, columnOf } from "./protocol";

export type Pose = [x: number, y: number, angle: number];

/** Fetches the values of some columns from one tick to another, no more than about `most` of each. */
type Series = (columns: Column[], from: number, to: number, most: number, then: (found: { values: number[][] }) => void) => void;

const BLOCK_TICKS = 2048;
const KEPT_BLOCKS = 200;

export class Track {
  private readonly blocks = new Map<number, Pose[]>();
  private readonly awaited = new Set<number>();

  constructor(
    private readonly about: About,
    private readonly series: Series,
    private readonly known: () => number,
    private readonly changed: () => void,
  ) {}

  /** Another run of the same shape. */
  restart(): void {
    this.blocks.clear();
    this.awaited.clear();
  }

  /** The poses from one tick to another that are here, in order; what is missing is fetched. */
  between(from: number, to: number): Pose[] {
    const found: Pose[] = [];
    for (let first = from - (from % BLOCK_TICKS); first <= to; first += BLOCK_TICKS) {
      const block = this.block(first / BLOCK_TICKS);
      for (const pose of block.slice(Math.max(0, from - first), to - first + 1)) found.push(pose);
    }
    return found;
  }

  /** The pose after a tick, if it is here; else it is fetched. */
  at(tick: number): Pose | undefined {
    return this.block(Math.floor(tick / BLOCK_TICKS))[tick % BLOCK_TICKS];
  }

  private block(place: number): Pose[] {
    const found = this.blocks.get(place) ?? [];
    const [from, to] = [place * BLOCK_TICKS + found.length, Math.min(this.known(), (place + 1) * BLOCK_TICKS - 1)];
    const columns = [0, 1, 2].map((number) => columnOf(this.about, "robot", number)).filter((column) => column !== null);
    if (from > to || columns.length < 3 || this.awaited.has(place)) return found;
    this.awaited.add(place);
    this.series(columns, from, to, BLOCK_TICKS, ({ values: [x, y, angle] }) => {
      this.awaited.delete(place);
      if (this.blocks.size > KEPT_BLOCKS) this.blocks.clear();
      this.blocks.set(place, [...found, ...x.map((_, row): Pose => [x[row], y[row], angle[row]])]);
      this.changed();
    });
    return found;
  }
}
