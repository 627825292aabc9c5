/** The hierarchy as a picture: sensors above, skills between, actuators below. */

import { graphlib, layout } from "@dagrejs/dagre";
import type { Edge, Hierarchy, Node } from "./protocol";

const NAMESPACE = "http://www.w3.org/2000/svg";
const LETTER = 7.9;
const SAID_LETTER = 5.6;
const HIGH = { skill: 42, sensor: 26, actuator: 26, memory: 26 };
const SAID_CHARACTERS = 26;

const [SMALLEST, LARGEST] = [0.72, 1.15]; // so many times as large as it is laid out: what does not fit is scrolled

interface Point {
  x: number;
  y: number;
}

interface Way extends Point {
  points: Point[]; // the edge's; its own place is that of its words
}

/** Draw it into an SVG; `chosen` is told of the node that somebody clicks. */
export function draw(svg: SVGSVGElement, of: Hierarchy, chosen: (node: Node) => void): void {
  const graph = new graphlib.Graph({ multigraph: true });
  graph.setGraph({ rankdir: "TB", nodesep: 16, ranksep: 46, marginx: 12, marginy: 12 });
  const known = new Set(of.nodes.map((node) => node.id));
  const used = new Set(of.edges.flatMap((edge) => [edge.from, edge.to]));
  const nodes = of.nodes.filter((node) => used.has(node.id) || node.noun === "skill");
  for (const node of nodes) graph.setNode(node.id, { width: width(node), height: HIGH[node.noun] });
  const edges = of.edges.filter((edge) => known.has(edge.from) && known.has(edge.to));
  edges.forEach((edge, number) => graph.setEdge(edge.from, edge.to, room(edge), String(number)));
  layout(graph);
  const whole = graph.graph() as { width: number; height: number };
  svg.replaceChildren();
  svg.setAttribute("viewBox", `0 0 ${whole.width} ${whole.height}`);
  svg.style.maxWidth = `${whole.width * LARGEST}px`;
  svg.style.minWidth = `${whole.width * SMALLEST}px`;
  edges.forEach((edge, number) => {
    svg.append(arrow(edge, graph.edge(edge.from, edge.to, String(number)) as Way));
  });
  for (const node of nodes) {
    const drawn = box(node, graph.node(node.id) as Point, node.id === of.master);
    drawn.addEventListener("click", () => chosen(node));
    svg.append(drawn);
  }
}

function width(node: Node): number {
  return Math.max(node.name.length * LETTER, node.about.length * LETTER * 0.82) + 22;
}

function box(node: Node, at: Point, isMaster: boolean): SVGElement {
  const group = made("g", { class: `node ${node.noun}${isMaster ? " master" : ""}`, transform: `translate(${at.x} ${at.y})` });
  const [wide, high] = [width(node), HIGH[node.noun]];
  group.append(made("rect", { x: -wide / 2, y: -high / 2, width: wide, height: high, rx: node.noun === "skill" ? 8 : high / 2 }));
  group.append(text(node.name, 0, node.about ? -3 : 4, "name"));
  if (node.about) group.append(text(node.about, 0, 13, "about"));
  group.append(titled(`${node.noun} ${node.name}${isMaster ? ", the master" : ""}`));
  return group;
}

function arrow(edge: Edge, { points, x, y }: Way): SVGElement {
  const group = made("g", { class: `edge ${edge.verb}` });
  group.append(made("path", { d: curve(points), "marker-end": "url(#head)" }));
  if (edge.said) {
    group.append(text(short(edge.said), x, y + 3, "said"));
  }
  group.append(titled(`${edge.verb} ${edge.said}`));
  return group;
}

/** The room that dagre keeps for what an edge says. */
function room(edge: Edge): object {
  return edge.said ? { width: short(edge.said).length * SAID_LETTER + 6, height: 12, labelpos: "c" } : {};
}

function short(said: string): string {
  return said.length > SAID_CHARACTERS ? `${said.slice(0, SAID_CHARACTERS - 1)}…` : said;
}

/** A smooth line through points: from the middle of each stretch to that of the next. */
function curve(points: Point[]): string {
  const [first, ...rest] = points as [Point, ...Point[]];
  const steps = rest.map((point, i) => {
    const next = rest[i + 1];
    return next ? `Q ${point.x} ${point.y} ${(point.x + next.x) / 2} ${(point.y + next.y) / 2}` : `L ${point.x} ${point.y}`;
  });
  return `M ${first.x} ${first.y} ${steps.join(" ")}`;
}

function titled(words: string): SVGElement {
  const title = made("title", {});
  title.textContent = words;
  return title;
}

function text(words: string, x: number, y: number, of: string): SVGElement {
  const found = made("text", { x, y, class: of, "text-anchor": "middle" });
  found.textContent = words;
  return found;
}

function made(name: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}
