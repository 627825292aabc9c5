/** What has happened, in the order of its ticks; a run may have a hundred thousand events. */

export interface Happened {
  tick: number;
  event: number;
}

export class Events {
  readonly all: Happened[] = [];

  get length(): number {
    return this.all.length;
  }

  add(happened: [tick: number, event: number][]): void {
    for (const [tick, event] of happened) this.all.push({ tick, event });
  }

  /** Another run is seen. */
  restart(): void {
    this.all.length = 0;
  }

  /** How many there are before a tick. */
  before(tick: number): number {
    let [low, high] = [0, this.all.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.all[middle].tick < tick) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The first event after a tick, or the last before it. */
  next(tick: number, direction: 1 | -1): Happened | undefined {
    return direction > 0 ? this.all[this.before(tick + 1)] : this.all[this.before(tick) - 1];
  }

  /** The one nearest to a tick, no farther than so many ticks. */
  nearest(tick: number, ticks: number): Happened | undefined {
    const after = this.before(tick);
    const near = [this.all[after - 1], this.all[after]].filter((one) => one && Math.abs(one.tick - tick) <= ticks);
    return near.sort((one, other) => Math.abs(one.tick - tick) - Math.abs(other.tick - tick))[0];
  }
}
