/** What is changed while the run is paused: a reading, an influence or a memory cell; a run beside this one goes on with it. */

import { shown } from "./names";
import type { About, Node, Send } from "./protocol";
import { type Row, valueAt } from "./rows";

const WHAT: Partial<Record<Node["kind"], string>> = { sensor: "reading", memory: "memory", skill: "influence" };

export class Edit {
  private readonly value = numberField("value", 0, 1, "any");
  private readonly lasts = numberField("ticks", 1, 1_000_000, "1");
  private readonly column = document.createElement("select");
  private node: Node | null = null;

  constructor(
    private readonly form: HTMLElement,
    private readonly about: About,
    send: Send,
    tick: () => number,
  ) {
    const button = document.createElement("button");
    button.textContent = "What if?";
    button.title = "lets another run go on beside this one, with this value";
    button.addEventListener("click", () => {
      const column = this.node?.columns[Number(this.column.value)];
      const [value, lasts] = [Number(this.value.value), Number(this.lasts.value)];
      if (column) send({ say: "change", fork: 0, tick: tick(), what: WHAT[this.node!.kind], column, value, lasts });
    });
    this.column.setAttribute("aria-label", "which of its readings");
    form.append(this.column, "set to", this.value, "for", this.lasts, "ticks", button);
    this.lasts.value = "60";
  }

  /** Offers to change this node, if it can be changed. */
  choose(node: number | null, row: Row | undefined): void {
    this.node = node === null ? null : this.about.nodes[node];
    const columns = this.node?.columns ?? [];
    this.column.replaceChildren(...columns.map((_, place) => new Option(`${shown(this.node!.name, 18)} ${place + 1}`, String(place))));
    this.column.hidden = columns.length < 2;
    if (row && columns.length) this.value.value = String(Number(valueAt(row, columns[0]).toFixed(3)));
    this.show(false, 0);
  }

  /** It is there while nothing plays; nothing is changed before the first tick. */
  show(playing: boolean, tick: number): void {
    const can = this.about.edits && this.about.source === "simulation" && !playing && tick > 0;
    this.form.hidden = !can || !this.node || !WHAT[this.node.kind] || this.node.master;
  }
}

function numberField(name: string, min: number, max: number, step: string): HTMLInputElement {
  const field = document.createElement("input");
  field.type = "number";
  field.setAttribute("aria-label", name);
  field.min = String(min);
  field.max = String(max);
  field.step = step;
  return field;
}
