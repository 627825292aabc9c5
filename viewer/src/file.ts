/** A page with its recording in it, opened from a disk: the same questions, answered without a server. */

import { frameOf, type Listener, type Said, type Send } from "./protocol";

/** The answers of the file that this page is, or null where it is none. */
export function openFile(_listener: Listener): Send | null {
  void frameOf;
  return null;
}
export type { Said };
