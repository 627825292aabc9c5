/** Where breakpoints hold: the ticks at which the page pauses by itself. */

import { Events } from "./events";
import { shown } from "./names";
import type { Playback } from "./playback";

const TEXT_CHARACTERS = 120;

export class Stops {
  readonly events = new Events();
  private readonly texts = new Map<number, string>();

  add(stops: [tick: number, text: string][]): void {
    this.events.add(stops.map(([tick]) => [tick, 0]));
    for (const [tick, text] of stops) {
      const others = this.texts.get(tick);
      this.texts.set(tick, (others ? `${others}; ` : "") + shown(text, TEXT_CHARACTERS));
    }
  }

  /** The lines that hold in a tick and did not before; nothing where none does. */
  at(tick: number): string | undefined {
    return this.texts.get(tick);
  }

  /** Another run is seen. */
  restart(): void {
    this.events.restart();
    this.texts.clear();
  }

  /** Pauses at the first that was come by. */
  between(before: number, now: number, playback: Playback): void {
    const first = playback.moving ? this.events.next(before, 1) : undefined;
    if (!first || first.tick > now) return;
    playback.pause();
    playback.jump(first.tick);
  }
}
