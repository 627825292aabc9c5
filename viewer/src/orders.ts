/** What is said to a robot that drives: a button for each of several orders, or a slider for a number. */

import type { About, Order, Send } from "./protocol";
import { type Row, valueAt } from "./rows";

const STEPS = 100; // of a slider

export class Orders {
  private readonly shows: ((row: Row) => void)[];

  constructor(pane: HTMLElement, about: About, send: Send) {
    pane.replaceChildren();
    pane.hidden = !about.orders.length;
    this.shows = about.orders.map((order) => {
      const group = document.createElement("div");
      group.setAttribute("role", "group");
      group.setAttribute("aria-label", `order ${order.name}`);
      group.append(order.name);
      pane.append(group);
      const say = (value: number) => send({ say: "order", name: order.name, value });
      const { columns } = about.nodes[order.node];
      const readings = (row: Row) => columns.map((column) => valueAt(row, column));
      const show = order.choices ? buttons(group, order.choices, say) : slider(group, order, say);
      return (row) => show(readings(row));
    });
  }

  /** Shows what counts in the tick of a row. */
  show(row: Row): void {
    for (const show of this.shows) show(row);
  }
}

/** A button for each, and before them one for none. */
function buttons(group: HTMLElement, choices: number, say: (value: number) => void) {
  const all = Array.from({ length: choices + 1 }, (_, value) => {
    const button = document.createElement("button");
    button.textContent = value ? String(value) : "none";
    button.addEventListener("click", () => say(value));
    return button;
  });
  group.append(...all);
  return (readings: number[]) => {
    const now = 1 + readings.indexOf(1);
    all.forEach((button, value) => button.setAttribute("aria-pressed", String(value === now)));
  };
}

function slider(group: HTMLElement, { name, low, high }: Order, say: (value: number) => void) {
  const [input, output] = [document.createElement("input"), document.createElement("output")];
  Object.assign(input, { type: "range", min: String(low), max: String(high), step: String((high - low) / STEPS) });
  input.setAttribute("aria-label", name);
  input.addEventListener("input", () => say(Number(input.value)));
  group.append(input, output);
  return ([reading]: number[]) => {
    const value = low + reading * (high - low);
    output.textContent = Number.isFinite(value) ? String(Number(value.toPrecision(3))) : "";
    if (Number.isFinite(value) && document.activeElement !== input) input.value = String(value);
  };
}
