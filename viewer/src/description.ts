/** What a node or an edge is, and its value, in words. */

import { digits, percent, shown } from "./names";
import { inWords } from "./promises";
import { type About, columnOf } from "./protocol";
import { type Row, valueAt } from "./rows";

/** What is chosen, or is under the mouse. */
export type Selected = { kind: "node" | "edge"; number: number } | null;

const READINGS_MAX = 24; // of one sensor

/** The words, and the value in a row: NaN where there is none. */
export function described(about: About, selected: NonNullable<Selected>, row: Row | undefined): { text: string; value: number } {
  if (selected.kind === "edge") {
    const { from, to, text, over } = about.edges[selected.number];
    const value = row ? valueAt(row, columnOf(about, "flow", selected.number)) : NaN;
    const name = `${shown(about.nodes[from].name)} \u2192 ${shown(about.nodes[to].name)}`;
    const line = shown(text, 160) || overWords(about, over); // of a recording there is no text
    return { text: `${name}: ${percent(value)}${line && `\n${line}`}`, value };
  }
  const { name, kind, says, columns, chooses, promises } = about.nodes[selected.number];
  const values = row ? columns.map((column) => valueAt(row, column)) : [];
  const several = values.length > 1 ? values.slice(0, READINGS_MAX).map(digits).join("  ") : percent(values[0] ?? NaN);
  const lines = [`${shown(name)} (${says ? `${kind}, ${says}` : kind}): ${several}`];
  if (row && chooses) lines.push(`chooses one: ${chosen(about, selected.number, row)}`);
  if (row) lines.push(...promises.map((promise) => inWords(promise, row)));
  return { text: lines.join("\n"), value: values[0] ?? NaN };
}

/** For whom alone an influence counts. */
export function overWords(about: About, over: number[]): string {
  return over.length ? `over ${over.map((node) => shown(about.nodes[node].name)).join(", ")}` : "";
}

/** Whom a skill that chooses one has sent its influence. */
function chosen(about: About, node: number, row: Row): string {
  const found = about.edges.findIndex(
    ({ from, to }, edge) => from === node && about.nodes[to].kind === "skill" && valueAt(row, columnOf(about, "flow", edge)) > 0,
  );
  return found < 0 ? "nobody now" : shown(about.nodes[about.edges[found].to].name);
}
