/** Why an actuator does what it does: each path from the master and its share of the command, as the server says. */

import { digits, percent, shown } from "./names";
import type { About, Send, Why as Answer } from "./protocol";

const ASK_MILLISECONDS = 120; // not more often, while it plays
const COUNTED_PATHS_MAX = 1e15; // which stands for more, too
const ROUNDING_NOTED = 1e-6; // below it shares add up for everybody

export class Why {
  private actuator: number | null = null; // its number among the commands
  private name = "";
  private asked = "";
  private askedAt = -Infinity;

  constructor(
    private readonly place: HTMLElement,
    private readonly about: About,
    private readonly send: Send,
  ) {}

  /** Asks about the actuator that is this node; about none, where it is no actuator. */
  choose(node: number | null): void {
    const actuators = [...this.about.nodes.keys()].filter((each) => this.about.nodes[each].kind === "actuator");
    const found = node === null ? -1 : actuators.indexOf(node);
    if ((found < 0 ? null : found) === this.actuator) return;
    this.actuator = found < 0 ? null : found;
    this.name = node === null ? "" : shown(this.about.nodes[node].name, 24);
    this.asked = "";
    if (this.actuator === null) this.place.replaceChildren();
  }

  /** Another run is seen, or the same through another connection. */
  restart(): void {
    this.asked = "";
  }

  /** Asks for a tick, if that has not been asked. */
  at(tick: number, fork: number, now: number): void {
    const question = `${fork}/${tick}/${this.actuator}`;
    if (this.actuator === null || question === this.asked || now - this.askedAt < ASK_MILLISECONDS || tick < 1) return;
    this.asked = question;
    this.askedAt = now;
    this.send({ say: "why", fork, tick, actuator: this.actuator });
  }

  show(answer: Answer): void {
    if (answer.actuator !== this.actuator) return;
    const head = document.createElement("p");
    head.className = "sum";
    head.textContent = `why ${this.name} is ${digits(answer.command)} at tick ${answer.tick}`;
    head.title = String(answer.command);
    const paths = [...answer.paths].sort((one, other) => Math.abs(other.share) - Math.abs(one.share));
    this.place.replaceChildren(head, ...paths.map((path) => this.path(path, answer.command)), ...others(answer));
  }

  /** Says why there is no answer. */
  refused(why: string): void {
    if (this.actuator !== null) this.place.replaceChildren(text("p", "note", shown(why, 200)));
  }

  private path({ path, value, influence, share }: Answer["paths"][number], command: number): HTMLElement {
    const line = document.createElement("div");
    line.className = "path";
    const bar = text("span", "bar", "");
    bar.style.transform = `scaleX(${Math.min(1, Math.abs(share / command)) || 0})`;
    const names = path.map((node) => shown(this.about.nodes[node]?.name ?? "?", 24));
    const ways = text("span", "way", names.slice(0, -1).join(" \u203a "));
    const numbers = text("span", "numbers", `value ${digits(value)} with ${percent(influence)} influence gives ${digits(share)}`);
    numbers.title = `value ${value}, influence ${influence}, share ${share}`;
    line.append(bar, ways, numbers);
    return line;
  }
}

/** What of the command no named path has made. */
function others({ paths, rest, rest_paths: many, neutral, rounding }: Answer): HTMLElement[] {
  const said: string[] = [];
  if (!paths.length) said.push(`nothing influences it: its neutral, ${digits(neutral)}`);
  if (many) said.push(`${digits(rest)} over ${many >= COUNTED_PATHS_MAX ? "10^15 or more" : many} other path${many === 1 ? "" : "s"}`);
  if (Math.abs(rounding) > ROUNDING_NOTED) said.push(`${digits(rounding)} by rounding of the engine's sums`);
  return said.map((line) => text("p", "note", line));
}

function text(name: string, kind: string, content: string): HTMLElement {
  const element = document.createElement(name);
  element.className = kind;
  element.textContent = content;
  return element;
}
