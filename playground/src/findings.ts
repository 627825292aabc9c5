/** Findings in the text: underlined where they are, and in words below their line. */

import { type Extension, RangeSet, type Range, StateEffect, StateField, type Text } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, WidgetType } from "@codemirror/view";
import type { Finding } from "./protocol";

const found = StateEffect.define<readonly Finding[]>();

class Words extends WidgetType {
  constructor(private readonly finding: Finding) {
    super();
  }

  override eq(other: Words): boolean {
    return other.finding.message === this.finding.message && other.finding.hint === this.finding.hint;
  }

  override toDOM(): HTMLElement {
    const whole = document.createElement("div"); // with room around the words: CodeMirror does not measure margins
    whole.className = "below";
    const place = whole.appendChild(document.createElement("div"));
    place.className = `words ${this.finding.severity}`;
    const message = place.appendChild(document.createElement("span"));
    message.className = "message";
    message.textContent = this.finding.message;
    if (this.finding.hint) place.appendChild(document.createElement("span")).textContent = this.finding.hint;
    const code = place.appendChild(document.createElement("code"));
    code.textContent = this.finding.code;
    return whole;
  }
}

function decorations(text: Text, findings: readonly Finding[]): DecorationSet {
  const ranges: Range<Decoration>[] = [];
  for (const finding of findings) {
    const from = Math.min(finding.from, text.length);
    const to = Math.min(finding.to, text.length);
    const line = text.lineAt(from);
    const end = Math.max(Math.min(to, line.to), from);
    if (end > from) ranges.push(Decoration.mark({ class: `underlined ${finding.severity}` }).range(from, end));
    ranges.push(Decoration.widget({ widget: new Words(finding), block: true, side: 1 }).range(line.to));
  }
  return RangeSet.of(ranges, true);
}

const field = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(before, transaction) {
    const said = transaction.effects.find((effect) => effect.is(found));
    return said ? decorations(transaction.state.doc, said.value as readonly Finding[]) : before.map(transaction.changes);
  },
  provide: (of) => EditorView.decorations.from(of),
});

export const findingsShown: Extension = field;

/** Show these findings of the text that stands in an editor. */
export function showFindings(view: EditorView, findings: readonly Finding[]): void {
  view.dispatch({ effects: found.of(findings) });
}
