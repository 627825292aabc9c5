/** The buttons and fields of playback. */

import { element, pressed } from "./elements";
import { type Playback, RATES } from "./playback";
import type { Timeline } from "./timeline";

export class Transport {
  private readonly rate = element<HTMLSelectElement>("rate");
  private readonly tick = element<HTMLInputElement>("tick");

  constructor(
    private readonly playback: Playback,
    timeline: Timeline,
    private readonly tickSeconds: number,
    isLive: boolean,
  ) {
    const to = (direction: 1 | -1) => {
      const found = timeline.next(playback.tick, direction);
      if (found) playback.jump(found.tick);
    };
    pressed("play", () => playback.toggle());
    pressed("to-begin", () => playback.jump(0));
    pressed("to-end", () => playback.end());
    pressed("live", () => playback.end());
    element("live").hidden = !isLive;
    if (isLive) playback.end();
    element("back").addEventListener("click", ({ shiftKey }) => playback.step(shiftKey ? -10 : -1));
    element("on").addEventListener("click", ({ shiftKey }) => playback.step(shiftKey ? 10 : 1));
    pressed("event-before", () => to(-1));
    pressed("event-after", () => to(1));
    for (const rate of RATES) this.rate.add(new Option(`${rate}\u00d7`, String(rate), rate === 1));
    this.rate.addEventListener("change", () => (playback.rate = Number(this.rate.value)));
    this.tick.addEventListener("change", () => {
      playback.jump(Number(this.tick.value) || 0);
      this.tick.blur(); // keys are the player's again
    });
  }

  show(): void {
    const { tick, known, over, moving, following, rate } = this.playback;
    const play = element("play");
    play.classList.toggle("playing", moving);
    element("live").setAttribute("aria-pressed", String(following));
    play.setAttribute("aria-label", moving ? "pause" : "play");
    if (document.activeElement !== this.tick) this.tick.value = String(tick);
    this.tick.max = String(known);
    this.rate.value = String(rate);
    const seconds = (ticks: number) => `${(ticks * this.tickSeconds).toFixed(2)}\u202fs`;
    element("clock").textContent = `${seconds(tick)} of ${seconds(known)}${over ? "" : " so far"}`;
  }
}
