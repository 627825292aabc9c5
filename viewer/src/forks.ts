/** Runs beside the one that is seen, which began with a change: one of them is shown with it. */

import { shown } from "./names";
import { refusal } from "./notice";
import type { About, Fork, Frame, Send, Ticks } from "./protocol";
import { Rows } from "./rows";

export interface Beside {
  number: number;
  from: number; // the tick of its change
  rows: Rows;
}

export class Forks {
  private readonly all = new Map<number, Beside>();

  constructor(
    private readonly select: HTMLSelectElement,
    private readonly about: About,
    private readonly send: Send,
    private readonly changed: () => void,
  ) {
    select.add(new Option("the run alone", "0"));
    select.addEventListener("change", changed);
  }

  /** The one that is shown beside the run. */
  get chosen(): Beside | undefined {
    return this.all.get(Number(this.select.value));
  }

  begun({ fork, tick, text }: Fork): void {
    this.all.set(fork, { number: fork, from: tick, rows: new Rows(this.about, fork, this.send, this.changed) });
    this.select.add(new Option(`beside: ${shown(text, 110)}`, String(fork), false, true));
    this.select.hidden = false;
    this.changed();
  }

  /** Another run is seen, which nothing is beside. */
  restart(): void {
    this.all.clear();
    this.select.length = 1;
    this.select.hidden = true;
    this.changed();
  }

  ticks({ fork, known, failed }: Ticks): void {
    const found = this.all.get(fork);
    if (found) found.rows.known = known;
    if (failed) refusal(`the run beside this one ended at tick ${known}: ${failed}`);
    this.changed();
  }

  frame(frame: Frame): void {
    this.all.get(frame.fork)?.rows.add(frame);
  }

  refused(ask: number): void {
    for (const { rows } of this.all.values()) rows.refused(ask);
  }

  /** Lets them go on with the run. */
  want(to: number): void {
    for (const { number, rows } of this.all.values()) if (to > rows.known) this.send({ say: "run", fork: number, to });
  }
}
