/** Which nodes of a hierarchy are open: a skill that is collapsed hides what only it leads to. */

import type { About } from "./protocol";

const OPEN_AT_FIRST = 30; // skills: more than that begin collapsed

export class Subtrees {
  readonly collapsed = new Set<number>();
  readonly below: number[][]; // of each node, the edges that leave it
  private readonly above: number[][];
  private readonly roots: number[];

  constructor(private readonly about: About) {
    this.below = about.nodes.map(() => []);
    this.above = about.nodes.map(() => []);
    about.edges.forEach((edge, number) => {
      this.below[edge.from].push(number);
      this.above[edge.to].push(number);
    });
    const skills = [...about.nodes.keys()].filter((node) => about.nodes[node].kind === "skill");
    const masters = skills.filter((node) => about.nodes[node].master);
    this.roots = masters.length ? masters : skills.filter((node) => !this.above[node].length);
    if (skills.length > OPEN_AT_FIRST) this.collapseFrom(OPEN_AT_FIRST);
  }

  /** The nodes that are seen, the master first, and the edges between them. */
  open(): { nodes: number[]; edges: number[] } {
    const nodes = new Set(this.roots);
    for (const node of nodes) {
      if (!this.collapsed.has(node)) for (const edge of this.below[node]) nodes.add(this.about.edges[edge].to);
    }
    const edges = [...nodes].flatMap((node) => (this.collapsed.has(node) ? [] : this.below[node]));
    return { nodes: [...nodes], edges };
  }

  /** Whether it has skills below it. */
  leads(node: number): boolean {
    return this.below[node].some((edge) => this.about.nodes[this.about.edges[edge].to].kind === "skill");
  }

  /** How many skills are below it. */
  size(node: number): number {
    const found = new Set([node]);
    for (const each of found) for (const edge of this.below[each]) found.add(this.about.edges[edge].to);
    return [...found].filter((each) => this.about.nodes[each].kind === "skill").length - 1;
  }

  toggle(node: number): void {
    if (!this.collapsed.delete(node)) this.collapsed.add(node);
  }

  all(open: boolean): void {
    this.collapsed.clear();
    if (!open) for (const root of this.roots) for (const edge of this.below[root]) this.shut(this.about.edges[edge].to);
  }

  /** Opens what leads to a node, by the first way there. */
  reveal(node: number): void {
    const seen = new Set([node]);
    for (let at = node; ; ) {
      const edge = this.above[at].find((each) => !seen.has(this.about.edges[each].from));
      if (edge === undefined) return;
      at = this.about.edges[edge].from;
      seen.add(at);
      this.collapsed.delete(at);
    }
  }

  private shut(node: number): void {
    if (this.leads(node)) this.collapsed.add(node);
  }

  private collapseFrom(most: number): void {
    const open = new Set(this.roots);
    for (const node of open) {
      const skills = this.below[node].map((edge) => this.about.edges[edge].to);
      if (open.size + skills.length > most && this.leads(node)) this.collapsed.add(node);
      else for (const skill of skills) open.add(skill);
    }
  }
}
