/** A hand on the wheel: keys and a gamepad, said many times a second for as long as somebody drives. */

import { element } from "./elements";
import type { About, Grip, Send } from "./protocol";

const SAY_MS = 50; // from one message to the next; what is not said again counts for half a second
const TURN = 0.5; // of the wheels, by keys
const SLOW = 0.4; // of all, while shift is held
const IDLE = 0.08; // of a stick that nobody moves
const WAYS: Record<string, [ahead: number, right: number]> = {
  ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, -TURN], ArrowRight: [0, TURN],
  w: [1, 0], s: [-1, 0], a: [0, -TURN], d: [0, TURN],
};
const PAIRS = ["eq", "rf", "tg", "yh", "uj", "ik", "ol"]; // more and less of all else, in its order

/** What is pushed, from -1 to 1: ahead, to the right, and of each that is driven by itself. */
export interface Push {
  ahead: number;
  right: number;
  own: number[];
}

/** The number for a push: 0 is neutral, 1 the most, -1 the least. */
function level({ neutral }: Grip, push: number): number {
  const within = Math.min(1, Math.max(-1, push));
  return neutral + within * (within > 0 ? 1 - neutral : neutral);
}

/** The numbers that a hand says, in the order of what it holds. */
export function numbers(grips: Grip[], { ahead, right, own }: Push): number[] {
  return grips.map((grip, i) => {
    if (grip.role === "left") return level(grip, ahead + right);
    if (grip.role === "right") return level(grip, ahead - right);
    if (grip.role === "ahead") return level(grip, ahead);
    if (grip.role === "turn") return level(grip, right / TURN);
    return level(grip, own[i]);
  });
}

export class Drive {
  private readonly down = new Set<string>();
  private readonly pairs = new Map<number, string>(); // the keys of what is driven by itself
  private readonly grips: Grip[];
  private timer = 0;
  private isSlow = false;

  constructor(about: About, private readonly send: Send, signal: AbortSignal) {
    this.grips = about.drive;
    const pane = element("drive");
    pane.hidden = !this.grips.length;
    if (!this.grips.length) return;
    const others = this.grips.flatMap((grip, i) => (grip.role ? [] : [i]));
    others.slice(0, PAIRS.length).forEach((i, k) => this.pairs.set(i, PAIRS[k]));
    element("drive-keys").textContent = this.help(others.length < this.grips.length);
    element("drive-layout").hidden = about.source !== "driven";
    element("drive-go").addEventListener("click", () => this.toggle(), { signal });
    element("drive-new").addEventListener("click", () => this.anew(), { signal });
    element("drive-go").textContent = "drive";
    document.addEventListener("keydown", (event) => this.press(event), { signal, capture: true });
    document.addEventListener("keyup", (event) => this.release(event), { signal, capture: true });
    window.addEventListener("blur", () => this.down.clear(), { signal });
    signal.addEventListener("abort", () => this.stop());
  }

  private help(moves: boolean): string {
    const parts = moves ? ["Arrows or w a s d, or the left stick"] : [];
    for (const [i, [more, less]] of this.pairs) parts.push(`${more} and ${less}: ${this.grips[i].name}`);
    return `${parts.join("; ")}. Shift: slowly. Space: drive, stop.`;
  }

  private get drives(): boolean {
    return this.timer !== 0;
  }

  private toggle(): void {
    if (this.drives) this.stop();
    else {
      this.timer = window.setInterval(() => this.say(), SAY_MS);
      this.say();
    }
    element("drive-go").setAttribute("aria-pressed", String(this.drives));
    element("drive-go").textContent = this.drives ? "stop" : "drive";
  }

  private stop(): void {
    window.clearInterval(this.timer);
    this.timer = 0;
    this.down.clear();
  }

  /** Another layout; who drives goes on in it. */
  private anew(): void {
    const seed = element<HTMLInputElement>("drive-seed").value.trim();
    this.send({ say: "layout", seed: seed || null });
    element("drive-new").blur();
  }

  private press(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches("input, textarea, select, dialog *")) return;
    const key = event.key.length > 1 ? event.key : event.key.toLowerCase();
    this.isSlow = event.shiftKey;
    if (key === " ") {
      if (!event.repeat) this.toggle();
    } else if (this.drives && (key in WAYS || [...this.pairs.values()].some((pair) => pair.includes(key)))) {
      this.down.add(key);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private release(event: KeyboardEvent): void {
    this.isSlow = event.shiftKey;
    this.down.delete(event.key.length > 1 ? event.key : event.key.toLowerCase());
    if (event.key === " ") event.preventDefault(); // it does not press the button that was clicked last
  }

  /** What keys and sticks push now. */
  private push(): Push {
    const pad = navigator.getGamepads().find((each) => each?.connected);
    const stick = (axis: number) => {
      const value = pad?.axes[axis] ?? 0;
      return Math.abs(value) < IDLE ? 0 : value;
    };
    const share = this.isSlow ? SLOW : 1;
    const sum = (way: 0 | 1) => share * [...this.down].reduce((all, key) => all + (WAYS[key]?.[way] ?? 0), 0);
    const places = [...this.pairs.keys()];
    const own = this.grips.map((_, i) => {
      const [more, less] = this.pairs.get(i) ?? "  ";
      const keys = share * (Number(this.down.has(more)) - Number(this.down.has(less)));
      const place = places.indexOf(i); // the right stick, up and down first
      return keys - (place === 0 ? stick(3) : place === 1 ? -stick(2) : 0);
    });
    return { ahead: sum(0) - stick(1), right: sum(1) + TURN * stick(0), own };
  }

  private say(): void {
    const values = numbers(this.grips, this.push());
    this.send({ say: "drive", values });
    element("drive-now").textContent = this.grips.map(({ name }, i) => `${name} ${values[i].toFixed(2)}`).join(", ");
  }
}
