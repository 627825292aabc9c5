/** The environment of a run as it draws itself: asked for the tick that is shown, one question at a time. */

import { element } from "./elements";
import type { Beside } from "./forks";
import { shown } from "./names";
import type { About, Drawn, Send } from "./protocol";

const REASON_CHARACTERS = 300;

export class Seen {
  private readonly figure = element("seen");
  private readonly image = element<HTMLImageElement>("seen-image");
  private readonly earlier = element("seen-earlier");
  private readonly changedImage = element<HTMLImageElement>("seen-changed-image");
  private readonly changedCaption = element("seen-changed");
  private readonly without = element("no-world");
  private readonly asked = new Map<number, number>(); // the tick that was asked for last, of each run
  private beside = 0; // the run that is shown with this one
  private waits = false;
  private stopped: boolean;

  constructor(
    about: About,
    private readonly send: Send,
    private readonly changed: () => void,
  ) {
    this.stopped = !about.drawn;
    this.figure.hidden = !about.drawn;
    this.without.hidden = !!about.world || about.drawn;
  }

  /** Another run of the same shape is seen, or the same one again. */
  restart(): void {
    this.asked.clear();
    this.waits = false;
  }

  /** Asks for a tick that is not seen, of this run or of the one beside it. */
  at(tick: number, beside?: Beside): void {
    this.choose(beside?.number ?? 0);
    if (this.stopped || this.waits) return;
    const last = Math.min(tick, beside?.rows.known ?? 0);
    if (this.asked.get(0) !== tick) this.ask(0, tick);
    else if (beside && this.asked.get(beside.number) !== last) this.ask(beside.number, last);
  }

  /** What was asked for; of a file that has not all images, the one before. */
  show({ fork, tick, image }: Drawn): void {
    this.waits = false;
    this.changed();
    if (fork && fork !== this.beside) return;
    const shows = fork ? this.changedImage : this.image;
    shows.src = image;
    shows.dataset.tick = String(tick);
    if (fork) return;
    this.earlier.hidden = tick === this.asked.get(0);
    this.earlier.textContent = `as it was after tick ${tick}`;
  }

  private choose(beside: number): void {
    if (beside === this.beside) return;
    this.asked.delete(beside);
    this.beside = beside;
    this.changedImage.hidden = this.changedCaption.hidden = !beside;
    this.changedImage.removeAttribute("src");
  }

  private ask(fork: number, tick: number): void {
    this.waits = true;
    this.asked.set(fork, tick);
    this.send({ say: "image", fork, tick });
  }

  /** Nothing can be drawn, and why. */
  refused(why: string): void {
    this.stopped = true;
    this.figure.hidden = true;
    this.without.hidden = false;
    this.without.textContent = shown(why, REASON_CHARACTERS);
  }
}
