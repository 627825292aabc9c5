/** The editor. */

import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { findingsShown } from "./findings";
import { mind } from "./language";

export function editor(parent: HTMLElement, text: string, changed: (text: string) => void): EditorView {
  const extensions = [
    lineNumbers(),
    history(),
    drawSelection(),
    highlightActiveLine(),
    EditorView.lineWrapping, // what is said below a line would else be as wide as the longest one
    keymap.of([...defaultKeymap, ...historyKeymap]),
    mind,
    findingsShown,
    EditorView.contentAttributes.of({ "aria-label": "the text of a mind", spellcheck: "false" }),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) changed(update.state.doc.toString());
    }),
  ];
  return new EditorView({ parent, state: EditorState.create({ doc: text, extensions }) });
}

/** Another text in the editor, as one change that can be taken back. */
export function replaceText(view: EditorView, text: string): void {
  view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
}

/** The line at an offset, or the declaration of a name: seen, and selected. */
export function goTo(view: EditorView, offset: number): void {
  const line = view.state.doc.lineAt(Math.min(offset, view.state.doc.length));
  view.dispatch({ selection: { anchor: line.from, head: line.to }, effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
  view.focus();
}
