/** The network of the skill that is chosen, where its links were learnt, too: thicker the greater a weight, dashed below 0.
 * A click makes it as large as the page, and small again. */

import { place } from "./layout";
import { digits, shown } from "./names";
import type { About, Grown } from "./protocol";
import { make, smooth } from "./svg";

const NAME_CHARACTERS = 18;
const CHARACTER_PIXELS = 7;
const HEIGHT_PIXELS = 22;
const THICKEST_PIXELS = 5;
const ASPECT = 1.5; // of the page
const MARGIN_PIXELS = 4;

export class Links {
  private drawn: Grown | null = null;

  constructor(
    private readonly picture: SVGSVGElement,
    private readonly about: About,
  ) {
    picture.onclick = () => picture.classList.toggle("large");
    picture.replaceChildren();
  }

  /** Draws what this node is made of; nothing, where it is no skill that grew. */
  choose(node: number | null): void {
    const name = node === null ? "" : this.about.nodes[node].name;
    const grown = this.about.links.find(({ skill }) => skill === name) ?? null;
    if (grown === this.drawn) return;
    this.drawn = grown;
    this.picture.classList.remove("large");
    this.picture.replaceChildren(...(grown ? parts(grown) : []));
    const { x, y, width, height } = this.picture.getBBox(); // loops stand out over what was laid out
    const box = [x - MARGIN_PIXELS, y - MARGIN_PIXELS, width + 2 * MARGIN_PIXELS, height + 2 * MARGIN_PIXELS];
    this.picture.setAttribute("viewBox", box.join(" "));
  }
}

function parts({ nodes, links }: Grown): SVGElement[] {
  const names = nodes.map(({ name }) => shown(name, NAME_CHARACTERS));
  const size = (node: number) => ({ width: CHARACTER_PIXELS * names[node].length + 14, height: HEIGHT_PIXELS });
  const ends = (link: number) => ({ from: links[link][0], to: links[link][1] });
  const placed = place([...nodes.keys()], [...links.keys()], ends, size, ASPECT);
  const most = Math.max(...links.map(([, , weight]) => Math.abs(weight)));
  const lines = links.map(([from, to, weight], link) => {
    const way = from === to ? loop(placed.centres.get(from)!, size(from).width) : smooth(placed.lines.get(link)!);
    const line = make("path", { class: weight < 0 ? "link below" : "link", d: way });
    line.style.strokeWidth = String(Math.max(0.7, (THICKEST_PIXELS * Math.abs(weight)) / most));
    line.append(titled(`${shown(nodes[from].name)} \u2192 ${shown(nodes[to].name)}: ${digits(weight)}`));
    return line;
  });
  const boxes = nodes.map(({ name, role }, node) => {
    const { x, y } = placed.centres.get(node)!;
    const { width, height } = size(node);
    const group = make("g", { class: `node ${role}`, transform: `translate(${x} ${y})` });
    const label = make("text", {});
    label.textContent = names[node];
    const round = role === "neuron" ? height / 2 : 4;
    group.append(make("rect", { class: "back", x: -width / 2, y: -height / 2, width, height, rx: round }), label, titled(shown(name)));
    return group;
  });
  return [...lines, ...boxes];
}

/** A line from the right side of a node to itself. */
function loop({ x, y }: { x: number; y: number }, width: number): string {
  return `M${x + width / 2 - 4} ${y - 8}c26 -10 26 26 0 16`;
}

function titled(text: string): SVGElement {
  const title = make("title", {});
  title.textContent = text;
  return title;
}
