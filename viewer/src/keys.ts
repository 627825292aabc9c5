/** What the keyboard does, and the help that says so. */

export interface Key {
  keys: string[]; // as KeyboardEvent.key has them, "Shift+" before those that are held with it
  shown: string;
  says: string;
  act(): void;
}

const WRITING = "input:not([type=checkbox]), textarea, select, [contenteditable]";

/** Listens to the whole page, but not where somebody writes; Escape leaves the field. */
export function listen(keys: Key[], signal: AbortSignal): void {
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (target.matches(WRITING)) {
      if (event.key === "Escape") target.blur();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === " " && target.matches("button, label, [role=button]")) return; // it presses the button
    const name = event.shiftKey && event.key.length > 1 ? `Shift+${event.key}` : event.key;
    const found = keys.find((key) => key.keys.includes(name));
    if (!found) return;
    event.preventDefault();
    found.act();
  }, { signal });
}

/** The table of all keys, for the dialog of help. */
export function helpRows(keys: Key[]): HTMLTableRowElement[] {
  return keys.map(({ shown, says }) => {
    const row = document.createElement("tr");
    const [key, text] = [document.createElement("th"), document.createElement("td")];
    key.scope = "row";
    key.textContent = shown;
    text.textContent = says;
    row.append(key, text);
    return row;
  });
}
