/** Where breakpoints hold: the ticks at which playing pauses. */

import { element } from "./elements";
import { shown } from "./names";
import type { Playback } from "./playback";

export class Stops {
  private readonly texts = new Map<number, string>();

  add(stops: [tick: number, text: string][]): void {
    for (const [tick, text] of stops) this.texts.set(tick, text);
  }

  /** Another run is seen. */
  restart(): void {
    this.texts.clear();
  }

  /** Pauses at the first that was come by. */
  between(before: number, now: number, playback: Playback): void {
    if (!playback.moving || !this.texts.size) return;
    for (let tick = before + 1; tick <= now; tick++) {
      const text = this.texts.get(tick);
      if (text === undefined) continue;
      playback.pause();
      playback.jump(tick);
      element("state").textContent = `stopped: ${shown(text, 120)}`;
      return;
    }
  }
}
