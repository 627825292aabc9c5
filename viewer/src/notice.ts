/** What the page has to say above everything else: why something was refused, for a while; that nobody answers any more, until somebody does. */

import { element } from "./elements";
import { shown } from "./names";

const REFUSAL_MILLISECONDS = 8000;
const NOTICE_CHARACTERS = 240;
let timer: ReturnType<typeof setTimeout> | undefined;
let stays = false;

/** Says why something was not done. */
export function refusal(why: string): void {
  if (stays) return; // what is wrong with the whole page is said already
  show(why);
  timer = setTimeout(() => (element("notice").hidden = true), REFUSAL_MILLISECONDS);
}

/** Says what is wrong with the whole page, until it is no more. */
export function trouble(why: string): void {
  show(why);
  stays = true;
}

export function noTrouble(): void {
  if (stays) element("notice").hidden = true;
  stays = false;
}

function show(text: string): void {
  clearTimeout(timer);
  const notice = element("notice");
  notice.textContent = shown(text, NOTICE_CHARACTERS);
  notice.hidden = false;
}
