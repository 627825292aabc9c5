/** What is chosen, in words in the panel, and what is under the pointer, in words beside it. */

import { described, type Selected } from "./description";
import type { Edit } from "./edit";
import { element } from "./elements";
import type { Links } from "./links";
import type { About } from "./protocol";
import type { Row } from "./rows";
import type { Why } from "./why";

const RIGHT_PIXELS = 14; // of the pointer
const BELOW_PIXELS = 16;

export class Selection {
  private selected: Selected = null;
  private over: Selected = null;
  private readonly nothing = element("chosen-text").textContent;

  constructor(
    private readonly about: About,
    private readonly why: Why,
    private readonly edit: Edit,
    private readonly links: Links,
    private readonly row: () => Row | undefined,
  ) {}

  /** Shows both as they are in the row that is seen. */
  show(): void {
    this.describe("chosen-text", this.selected);
    this.describe("tip", this.over);
    this.links.choose(this.selected?.kind === "node" ? this.selected.number : null);
  }

  choose(selected: Selected): void {
    this.selected = selected;
    const node = selected?.kind === "node" ? selected.number : null;
    this.why.choose(node);
    this.edit.choose(node, this.row());
    this.links.choose(node);
    this.describe("chosen-text", selected);
    if (!selected) element("chosen-text").textContent = this.nothing;
  }

  /** Says what the pointer is at, inside of the pane. */
  point(at: Selected, event: PointerEvent): void {
    const tip = element("tip");
    tip.hidden = !at;
    if (at?.number !== this.over?.number || at?.kind !== this.over?.kind) this.hover(at);
    const { left, top, width, height } = (event.currentTarget as Element).getBoundingClientRect();
    const x = Math.min(event.clientX - left + RIGHT_PIXELS, width - tip.offsetWidth);
    const below = event.clientY - top + BELOW_PIXELS;
    const y = below + tip.offsetHeight <= height ? below : event.clientY - top - tip.offsetHeight - BELOW_PIXELS / 2;
    tip.style.transform = `translate(${Math.max(0, x)}px, ${Math.max(0, y)}px)`;
  }

  private hover(at: Selected): void {
    this.over = at;
    const actuator = at?.kind === "node" && this.about.nodes[at.number].kind === "actuator";
    const chosen = this.selected?.kind === "node" ? this.selected.number : null;
    this.why.choose(actuator ? at.number : chosen);
    this.describe("tip", at);
  }

  private describe(name: string, selected: Selected): void {
    if (!selected) return;
    const { text, value } = described(this.about, selected, this.row());
    const place = element(name);
    place.textContent = text;
    place.title = String(value);
    place.dataset.value = String(value);
  }
}
