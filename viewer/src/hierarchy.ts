/** The hierarchy as SVG: what acts now is lit, and edges are as thick as what they transmit. */

import { Camera } from "./camera";
import { EdgeCanvas } from "./edge_canvas";
import { type Placed, place, type Size } from "./layout";
import { overWords, type Selected } from "./description";
import { make, smooth } from "./svg";
import { shown } from "./names";
import { light, marks } from "./promises";
import { type About, type Column, columnOf } from "./protocol";
import { type Row, valueAt } from "./rows";
import { Subtrees } from "./subtrees";

export interface Shown {
  over(selected: Selected, event: PointerEvent): void;
  chosen(selected: Selected): void;
}

const NODE_HEIGHT = 34;
const CHARACTER_PIXELS = 7.4;
const NODE_CHARACTERS = 26;
const NODE_WIDTH_MIN = 72;
const LEVELS = 48; // so many widths and glows there are: what has not changed is not touched
const EDGE_PIXELS_MAX = 9;
const TAB_STOPS_MAX = 80; // with more than that, edges are not stops of the tab key
const CHOICE_PIXELS = 5;
const MANY_EDGES = 400; // then they are on a canvas, those that transmit nothing are not seen, and all are drawn less often
const MANY_MILLISECONDS = 60;
const MARGIN = { above: 36, below: 26 }; // for the title and the legend
const LARGEST_SCALE_AT_FIRST = 1.25;
const SMALLEST_SCALE_AT_FIRST = 0.7; // can be read; then the master stays in sight, and the rest is moved into it

interface Drawn {
  node: SVGElement;
  level: number;
  column: Column | null;
  marks: SVGElement[]; // of its promises
}

export class Hierarchy {
  private readonly camera: Camera;
  private readonly plane: SVGGElement;
  private readonly canvas: EdgeCanvas;
  private readonly subtrees: Subtrees;
  private readonly nodes = new Map<number, Drawn>();
  private readonly edges = new Map<number, Drawn>();
  private placed: Placed = { centres: new Map(), lines: new Map(), width: 1, height: 1 };
  private selected: Selected = null;
  private many: number[] = []; // the edges that are on the canvas
  private drawnAt = -Infinity;

  constructor(
    private readonly svg: SVGSVGElement,
    canvas: HTMLCanvasElement,
    private readonly about: About,
    private readonly listener: Shown,
    private readonly changed: () => void,
  ) {
    this.plane = make("g", {}) as SVGGElement;
    svg.append(this.plane);
    this.camera = new Camera(svg, MARGIN, () => this.move());
    this.canvas = new EdgeCanvas(canvas, this.camera);
    this.subtrees = new Subtrees(about);
    svg.addEventListener("click", (event) => !this.camera.dragged && this.choose(this.under(event)));
    svg.addEventListener("dblclick", (event) => this.toggle(this.at(event.target)));
    svg.addEventListener("pointermove", (event) => listener.over(this.under(event), event));
    svg.addEventListener("pointerleave", (event) => listener.over(null, event));
    svg.addEventListener("keydown", (event) => this.key(event));
    this.layout();
  }

  fit(): void {
    this.camera.fit(0, 0, this.placed.width, this.placed.height, LARGEST_SCALE_AT_FIRST);
  }

  zoom(factor: number): void {
    this.camera.zoom(factor);
  }

  resize(): void {
    if (this.camera.touched) return;
    this.fit();
    this.camera.zoom(Math.max(1, SMALLEST_SCALE_AT_FIRST / this.camera.scale), this.svg.clientWidth / 2, MARGIN.above);
    this.camera.touched = false;
  }

  collapseAll(collapsed: boolean): void {
    this.subtrees.all(!collapsed);
    this.layout();
    this.fit();
  }

  /** Shows a node, wherever it is, and chooses it. */
  reveal(number: number): void {
    this.subtrees.reveal(number);
    if (!this.nodes.has(number)) this.layout();
    const centre = this.placed.centres.get(number);
    if (centre && !this.sees(centre)) {
      this.camera.x = this.svg.clientWidth / 2 - centre.x * this.camera.scale;
      this.camera.y = this.svg.clientHeight / 2 - centre.y * this.camera.scale;
      this.camera.touched = true;
      this.move();
    }
    this.choose({ kind: "node", number });
  }

  private sees({ x, y }: { x: number; y: number }): boolean {
    const [left, top] = [this.camera.x + x * this.camera.scale, this.camera.y + y * this.camera.scale];
    return left > 0 && left < this.svg.clientWidth && top > 0 && top < this.svg.clientHeight;
  }

  choose(selected: Selected): void {
    this.drawnOf(this.selected)?.node.classList.remove("selected");
    this.selected = selected;
    this.drawnOf(selected)?.node.classList.add("selected");
    this.listener.chosen(selected);
  }

  /** Lights it as a row has it, if it is time; what is as it was is not touched. Whether it did. */
  draw(row: Row, now: number): boolean {
    if (this.many.length && now - this.drawnAt < MANY_MILLISECONDS) return false;
    this.drawnAt = now;
    for (const edge of this.many) this.canvas.light(edge, valueAt(row, columnOf(this.about, "flow", edge)));
    if (this.many.length) this.canvas.draw();
    for (const [number, drawn] of this.nodes) {
      light(drawn.marks, this.about.nodes[number].promises, row);
      const level = levelOf(valueAt(row, drawn.column));
      if (level === drawn.level) continue;
      drawn.level = level;
      (drawn.node.children[1] as SVGElement).style.opacity = String(level / LEVELS);
      drawn.node.classList.toggle("lit", level > 0);
    }
    for (const drawn of this.edges.values()) {
      const level = levelOf(valueAt(row, drawn.column));
      if (level === drawn.level) continue;
      drawn.level = level;
      const style = (drawn.node.children[0] as SVGElement).style;
      style.strokeWidth = `${1 + ((EDGE_PIXELS_MAX - 1) * level) / LEVELS}`;
      drawn.node.classList.toggle("lit", level > 0);
    }
    return true;
  }

  private drawnOf(selected: Selected): Drawn | undefined {
    return selected ? (selected.kind === "node" ? this.nodes : this.edges).get(selected.number) : undefined;
  }

  private under(event: MouseEvent): Selected {
    const { left, top } = this.svg.getBoundingClientRect();
    const edge = this.canvas.at(event.clientX - left, event.clientY - top);
    return this.at(event.target) ?? (edge === null ? null : { kind: "edge", number: edge });
  }

  private at(target: EventTarget | null): Selected {
    const found = (target as Element).closest<SVGElement>("[data-node],[data-edge]")?.dataset;
    if (found?.node) return { kind: "node", number: Number(found.node) };
    return found?.edge ? { kind: "edge", number: Number(found.edge) } : null;
  }

  private key(event: KeyboardEvent): void {
    if (event.key !== "Enter") return;
    const at = this.at(event.target);
    if (this.selected?.kind === "node" && this.selected.number === at?.number) this.toggle(at);
    else this.choose(at);
    event.stopPropagation();
  }

  private toggle(at: Selected): void {
    if (at?.kind !== "node" || !this.subtrees.leads(at.number)) return;
    const before = this.placed.centres.get(at.number);
    this.subtrees.toggle(at.number);
    this.layout();
    const after = this.placed.centres.get(at.number);
    if (before && after) { // it stays where it was on the screen
      this.camera.x += (before.x - after.x) * this.camera.scale;
      this.camera.y += (before.y - after.y) * this.camera.scale;
      this.camera.touched = true;
      this.move();
    }
    this.choose(at);
  }

  private size(node: number): Size {
    const characters = shown(this.about.nodes[node].name, NODE_CHARACTERS).length;
    const folded = this.subtrees.leads(node) ? 22 : 0;
    return { width: Math.max(NODE_WIDTH_MIN, 24 + characters * CHARACTER_PIXELS + folded), height: NODE_HEIGHT };
  }

  private layout(): void {
    const open = this.subtrees.open();
    this.placed = place(open.nodes, open.edges, (edge) => this.about.edges[edge], (node) => this.size(node), this.aspect);
    this.many = open.edges.length > MANY_EDGES ? open.edges : [];
    this.canvas.set(new Map(this.many.map((edge) => [edge, this.placed.lines.get(edge)!])));
    this.drawnAt = -Infinity;
    this.nodes.clear();
    this.edges.clear();
    for (const edge of this.many.length ? [] : open.edges) this.edges.set(edge, this.edge(edge, open.edges.length));
    for (const node of open.nodes) this.nodes.set(node, this.node(node));
    this.plane.replaceChildren(...[...this.edges.values(), ...this.nodes.values()].map(({ node }) => node));
    this.drawnOf(this.selected)?.node.classList.add("selected");
    this.changed();
  }

  private get aspect(): number {
    return this.svg.clientWidth / this.svg.clientHeight || 1;
  }

  private edge(number: number, among: number): Drawn {
    const { from, to, over } = this.about.edges[number];
    const name = `${shown(this.about.nodes[from].name)} to ${shown(this.about.nodes[to].name)} ${overWords(this.about, over)}`.trim();
    const node = make("g", { class: `edge${over.length ? " over" : ""}`, "data-edge": number, role: "button", "aria-label": name });
    if (among <= TAB_STOPS_MAX) node.setAttribute("tabindex", "0");
    const line = this.placed.lines.get(number)!;
    const d = smooth(line);
    node.append(make("path", { class: "line", d }), make("path", { class: "touch", d }));
    if (this.about.nodes[from].chooses && this.about.nodes[to].kind === "skill") {
      const [{ x, y }, next] = line;
      const share = CHOICE_PIXELS / (Math.hypot(next.x - x, next.y - y) || 1);
      const [cx, cy] = [x + share * (next.x - x), y + share * (next.y - y)]; // it touches the box
      node.append(make("circle", { class: "choice", cx, cy, r: CHOICE_PIXELS }));
    }
    return { node, level: -1, column: columnOf(this.about, "flow", number), marks: [] };
  }

  private node(number: number): Drawn {
    const { name, kind, columns, master, promises } = this.about.nodes[number];
    const { width, height } = this.size(number);
    const { x, y } = this.placed.centres.get(number)!;
    const node = make("g", {
      class: `node ${kind}${master ? " master" : ""}`,
      "data-node": number,
      transform: `translate(${x - width / 2} ${y - height / 2})`,
      tabindex: 0,
      role: "button",
      "aria-label": `${kind} ${shown(name)}`,
    });
    const shape = { width, height, rx: kind === "skill" ? 9 : 3 };
    const text = make("text", { x: width / 2 - (this.subtrees.leads(number) ? 9 : 0), y: height / 2 });
    text.textContent = shown(name, NODE_CHARACTERS);
    node.append(make("rect", { class: "back", ...shape }), make("rect", { class: "glow", ...shape }), text);
    if (this.subtrees.leads(number)) {
      const fold = make("text", { class: "fold", x: width - 15, y: height / 2 });
      const collapsed = this.subtrees.collapsed.has(number);
      fold.textContent = collapsed ? `+${this.subtrees.size(number)}` : "\u2212";
      fold.addEventListener("click", (event) => (event.stopPropagation(), this.toggle({ kind: "node", number })));
      node.append(fold);
    }
    const found = marks(promises, width, height);
    node.append(...found);
    return { node, level: -1, column: columns[0] ?? null, marks: found };
  }

  private move(): void {
    const { x, y, scale } = this.camera;
    this.plane.setAttribute("transform", `translate(${x} ${y}) scale(${scale})`);
    this.svg.classList.toggle("far", scale < 0.35);
    if (this.many.length) this.canvas.draw();
  }
}

function levelOf(value: number): number {
  return value > 0 ? Math.max(1, Math.round(Math.min(1, value) * LEVELS)) : 0;
}
