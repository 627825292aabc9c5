/** What a node or an edge is, and its value, in words. */

import { digits, percent, shown } from "./names";
import { type About, columnOf } from "./protocol";
import { type Row, valueAt } from "./rows";

/** What is chosen, or is under the mouse. */
export type Selected = { kind: "node" | "edge"; number: number } | null;

const READINGS_MAX = 24; // of one sensor

/** The words, and the value in a row: NaN where there is none. */
export function described(about: About, selected: NonNullable<Selected>, row: Row | undefined): { text: string; value: number } {
  if (selected.kind === "edge") {
    const { from, to, text } = about.edges[selected.number];
    const value = row ? valueAt(row, columnOf(about, "flow", selected.number)) : NaN;
    const name = `${shown(about.nodes[from].name)} \u2192 ${shown(about.nodes[to].name)}`;
    return { text: `${name}: ${percent(value)}${text ? `\n${shown(text, 160)}` : ""}`, value };
  }
  const { name, kind, says, columns } = about.nodes[selected.number];
  const values = row ? columns.map((column) => valueAt(row, column)) : [];
  const several = values.length > 1 ? values.slice(0, READINGS_MAX).map(digits).join("  ") : percent(values[0] ?? NaN);
  return { text: `${shown(name)} (${says ? `${kind}, ${says}` : kind}): ${several}`, value: values[0] ?? NaN };
}
