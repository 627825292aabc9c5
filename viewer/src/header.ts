/** What stands above a run, and the buttons that show all of it. */

import { element, pressed } from "./elements";
import type { Hierarchy } from "./hierarchy";
import { shown } from "./names";
import type { About } from "./protocol";
import type { World } from "./world";

/** What grows without being asked, and how that is said. */
export const LIVE: Partial<Record<About["source"], string>> = { robot: "live from the robot", environment: "live from an environment", driven: "driven by hand" };

const CHANGED: About["source"][] = ["simulation", "training", "driven"]; // by one page; a file is changed by none

/** The title of a run, and where it comes from. */
export function showTitle({ title, source, edits }: About): void {
  const text = shown(title, 120);
  const others = !edits && CHANGED.includes(source) && !document.getElementById("recording");
  element("title").textContent = text;
  element("source").textContent = (LIVE[source] ?? source) + (others ? ", another page may change it" : "");
  document.title = `${text} \u2013 mind view`;
}

/** The buttons of help, of the hierarchy and of the world. */
export function listenToButtons({ hierarchy, world, follow }: { hierarchy: Hierarchy; world: World | null; follow(): void }): void {
  pressed("help", () => element<HTMLDialogElement>("keys").showModal());
  pressed("close-keys", () => element<HTMLDialogElement>("keys").close());
  pressed("hierarchy-fit", () => hierarchy.fit());
  pressed("open-all", () => hierarchy.collapseAll(false));
  pressed("close-all", () => hierarchy.collapseAll(true));
  pressed("world-fit", () => world?.fit());
  pressed("world-follow", follow);
}
