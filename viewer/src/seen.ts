/** The environment of a run as it draws itself: asked for the tick that is shown, one question at a time. */

import { element } from "./elements";
import { shown } from "./names";
import type { About, Drawn, Send } from "./protocol";

const ELSEWHERE = "The world of this run is an environment of its own, which is not drawn here: what the mind read and did is on the right and below.";
const REASON_CHARACTERS = 300;

export class Seen {
  private readonly image = document.createElement("img");
  private readonly without = element("no-world");
  private tick = -1; // that is seen
  private waits = false;
  private stopped: boolean;

  constructor(
    about: About,
    private readonly send: Send,
    private readonly changed: () => void,
  ) {
    document.getElementById("seen")?.remove();
    this.stopped = !about.drawn;
    this.image.id = "seen";
    this.image.alt = "the environment as it draws itself";
    if (about.drawn) this.without.before(this.image);
    this.without.hidden = !!about.world || about.drawn;
    if (about.task && !about.world) this.without.textContent = ELSEWHERE;
  }

  /** Another run of the same shape is seen, or the same one again. */
  restart(): void {
    this.tick = -1;
    this.waits = false;
  }

  /** Asks for a tick that is not seen. */
  at(tick: number): void {
    if (this.stopped || this.waits || tick === this.tick) return;
    this.waits = true;
    this.send({ say: "image", fork: 0, tick });
  }

  show({ tick, png }: Drawn): void {
    this.image.src = `data:image/png;base64,${png}`;
    this.image.dataset.tick = String(tick);
    this.tick = tick;
    this.waits = false;
    this.changed();
  }

  /** Nothing can be drawn, and why. */
  refused(why: string): void {
    this.stopped = true;
    this.image.remove();
    this.without.hidden = false;
    this.without.textContent = shown(why, REASON_CHARACTERS);
  }
}
