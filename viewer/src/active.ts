/** The list of what acts now, most influence first; and, while something is searched, of what bears such a name. */

import { percent, shown } from "./names";
import type { About, Node } from "./protocol";
import { type Row, valueAt } from "./rows";

const ROWS_MAX = 60;
const REDRAW_MILLISECONDS = 100;
const ACTIVE_INFLUENCE = 0.005;

interface Line {
  item: HTMLLIElement;
  name: HTMLSpanElement;
  kind: HTMLSpanElement;
  value: HTMLSpanElement;
  bar: HTMLSpanElement;
  node: number;
}

export class ActiveList {
  private readonly lines: Line[] = [];
  private readonly skills: number[];
  private drawnAt = -Infinity;
  private row: Row | undefined;

  constructor(
    private readonly list: HTMLElement,
    private readonly search: HTMLInputElement,
    private readonly count: HTMLElement,
    private readonly about: About,
    private readonly chosen: (node: number) => void,
  ) {
    this.skills = [...about.nodes.keys()].filter((node) => about.nodes[node].kind === "skill");
    search.addEventListener("input", () => this.fill());
    search.addEventListener("keydown", (event) => event.key === "Enter" && this.lines[0] && chosen(this.lines[0].node));
  }

  /** Shows a row; not more often than can be read. Whether it did. */
  draw(row: Row, now: number): boolean {
    this.row = row;
    if (now - this.drawnAt < REDRAW_MILLISECONDS) return false;
    this.drawnAt = now;
    this.fill();
    return true;
  }

  private fill(): void {
    const row = this.row;
    if (!row) return;
    const searched = this.search.value.trim().toLowerCase();
    const value = (node: number) => valueAt(row, this.about.nodes[node].columns[0] ?? null);
    const nodes = searched
      ? [...this.about.nodes.keys()].filter((node) => this.about.nodes[node].name.toLowerCase().includes(searched))
      : this.skills.filter((node) => value(node) >= ACTIVE_INFLUENCE).sort((a, b) => value(b) - value(a));
    this.count.textContent = searched ? `${nodes.length} found` : `${nodes.length} of ${this.skills.length} skills act now`;
    const seen = nodes.slice(0, ROWS_MAX);
    while (this.lines.length < seen.length) this.lines.push(this.line());
    while (this.lines.length > seen.length) this.lines.pop()!.item.remove();
    seen.forEach((node, place) => this.set(this.lines[place], node, this.about.nodes[node], value(node)));
  }

  private set(line: Line, node: number, { name, kind }: Node, value: number): void {
    if (line.node !== node) {
      line.node = node;
      line.name.textContent = shown(name);
      line.kind.textContent = kind === "skill" ? "" : kind;
    }
    line.value.textContent = percent(value);
    line.bar.style.transform = `scaleX(${Math.min(1, Math.max(0, value)) || 0})`;
  }

  private line(): Line {
    const item = document.createElement("li");
    const button = document.createElement("button");
    const [bar, name, kind, value] = ["bar", "name", "kind", "value"].map((part) => {
      const span = document.createElement("span");
      span.className = part;
      return span;
    });
    button.append(bar, name, kind, value);
    item.append(button);
    this.list.append(item);
    const line: Line = { item, name, kind, value, bar, node: -1 };
    button.addEventListener("click", () => this.chosen(line.node));
    return line;
  }
}
