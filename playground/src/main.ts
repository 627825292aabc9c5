/** The page: an editor, what is found in its text, and the hierarchy that it declares. */

import examples from "../../build/playground/examples.json";
import { editor, goTo, replaceText } from "./editor";
import { showFindings } from "./findings";
import { fragmentOf, textIn } from "./fragment";
import { FrontEnd } from "./front_end";
import { draw } from "./hierarchy";
import type { Answer, Node } from "./protocol";

const PAUSE_MILLISECONDS = 150; // in typing, before a text is looked at
const TITLES = Object.keys(examples) as (keyof typeof examples)[];

const element = <T extends Element = HTMLElement>(id: string) => document.getElementById(id) as unknown as T;
const [state, progress, notice] = [element("state"), element<HTMLProgressElement>("progress"), element("notice")];
const [tidy, share] = [element<HTMLButtonElement>("tidy"), element<HTMLButtonElement>("share")];
const [choice, picture, empty] = [element<HTMLSelectElement>("examples"), element<SVGSVGElement>("hierarchy"), element("empty")];

let tidied: string | null = null;
let waiting = 0;

const shared = await textIn(location.hash);
const view = editor(element("editor"), shared ?? examples[TITLES[0]!], (text) => {
  window.clearTimeout(waiting);
  waiting = window.setTimeout(() => frontEnd.ask(text), PAUSE_MILLISECONDS);
});
const text = () => view.state.doc.toString();

const frontEnd = new FrontEnd({
  loaded(part) {
    progress.value = part;
    state.textContent = part < 1 ? `loading Python, ${Math.round(part * 100)} %` : "starting Python";
  },
  ready() {
    progress.hidden = true;
    state.textContent = "";
  },
  answered(of, answer) {
    if (of === text()) show(answer);
  },
  failed(message) {
    progress.hidden = true;
    notice.hidden = false;
    notice.textContent = `The compiler does not answer: ${message}`;
  },
});

function show({ findings, hierarchy, tidy: tidyText }: Answer): void {
  showFindings(view, findings);
  const errors = findings.filter((finding) => finding.severity === "error").length;
  const warnings = findings.length - errors;
  state.textContent = [counted(errors, "mistake"), counted(warnings, "finding")].filter(Boolean).join(", ") || "nothing wrong";
  state.className = errors ? "error" : warnings ? "warning" : "good";
  tidied = tidyText;
  tidy.disabled = tidyText === null || tidyText === text();
  if (hierarchy) {
    draw(picture, hierarchy, declared);
    picture.querySelector(".master")?.scrollIntoView({ block: "nearest", inline: "center" }); // of what is too wide
  }
  picture.classList.toggle("old", !hierarchy); // of the text as it last compiled
  empty.hidden = hierarchy !== null || picture.childElementCount > 0;
}

function counted(number: number, noun: string): string {
  return number ? `${number} ${noun}${number > 1 ? "s" : ""}` : "";
}

function declared(node: Node): void {
  const name = node.name.replace(/[.+]/g, "\\$&");
  const found = new RegExp(`^[ \\t]*${node.noun}[ \\t]+${name}(?![\\w.+])`, "m").exec(text());
  if (found) goTo(view, found.index);
}

choice.append(...TITLES.map((title) => new Option(title, title)));
choice.value = shared === null ? TITLES[0]! : "";
choice.addEventListener("change", () => {
  history.replaceState(null, "", location.pathname);
  replaceText(view, examples[choice.value as keyof typeof examples]);
});
tidy.addEventListener("click", () => {
  if (tidied !== null) replaceText(view, tidied);
});
share.addEventListener("click", async () => {
  history.replaceState(null, "", await fragmentOf(text()));
  await navigator.clipboard?.writeText(location.href).catch(() => undefined);
  share.textContent = "Link copied";
  window.setTimeout(() => (share.textContent = "Copy link"), 2000);
});
window.addEventListener("hashchange", async () => {
  const found = await textIn(location.hash);
  if (found !== null && found !== text()) replaceText(view, found);
});
element("theme").addEventListener("click", () => {
  const dark = document.documentElement.dataset.theme === "dark";
  document.documentElement.dataset.theme = dark ? "light" : "dark";
});
document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
frontEnd.ask(text());
