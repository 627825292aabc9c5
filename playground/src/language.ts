/** Colours of the language: a line begins with its noun or its verb, and what is Capitalised is a name of a whole. */

import { HighlightStyle, StreamLanguage, type StringStream, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import words from "../../build/playground/words.json";

const JOINTS = new Set(words.joints);
const BEGINNINGS = new Map([
  ...words.nouns.map((word) => [word, "keyword"] as const),
  ...[...words.settings, ...words.verbs].map((word) => [word, "controlKeyword"] as const),
]);
const UNIT = new RegExp(`^[ \\t]*(?:%|(?:${words.units.filter((unit) => unit !== "%").join("|")})\\b)`);

interface State {
  begun: boolean; // whether a word stands before on this line
}

function token(stream: StringStream, state: State): string | null {
  if (stream.sol()) state.begun = false;
  if (stream.eatSpace()) return null;
  if (stream.match(/^#.*/)) return "comment";
  if (stream.match(/^"[^"]*"?/)) return "string";
  if (stream.match(/^\d+(?:\.\d+)?(?:\/\d+)?/)) {
    stream.match(UNIT);
    return "number";
  }
  const word = stream.match(/^[\p{L}_][\p{L}\p{N}_.+]*/u) as RegExpMatchArray | null;
  if (!word) {
    stream.next();
    return "operator";
  }
  const first = !state.begun;
  state.begun = true;
  if (first && BEGINNINGS.has(word[0])) return BEGINNINGS.get(word[0])!;
  if (JOINTS.has(word[0])) return "operatorKeyword";
  return /(?:^|\.)\p{Lu}/u.test(word[0]) ? "typeName" : "variableName";
}

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--comment)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--string)" },
  { tag: tags.number, color: "var(--number)" },
  { tag: tags.keyword, color: "var(--noun)", fontWeight: "600" },
  { tag: tags.controlKeyword, color: "var(--verb)" },
  { tag: tags.operatorKeyword, color: "var(--joint)" },
  { tag: tags.typeName, color: "var(--whole)", fontWeight: "600" },
]);

export const mind = [
  StreamLanguage.define<State>({ startState: () => ({ begun: false }), token, languageData: { commentTokens: { line: "#" } } }),
  syntaxHighlighting(colours),
];
