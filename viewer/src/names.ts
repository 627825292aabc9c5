/** Names as they are shown: they come from files of anybody, so they are cut, and nothing in them turns the line around. */

const NAME_CHARACTERS = 60;
// Controls, and what changes the direction of text or is not seen at all.
const UNSEEN = /[\u0000-\u001f\u007f-\u009f\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]/g;

/** A name that can stand in a line. */
export function shown(name: string, characters = NAME_CHARACTERS): string {
  const cut = name.slice(0, characters + 1).replace(UNSEEN, "\ufffd");
  return cut.length > characters ? `${cut.slice(0, characters - 1)}\u2026` : cut;
}

/** A number as it is read: four digits that matter; the exact one stands in the title of what shows it. */
export function digits(value: number): string {
  if (!Number.isFinite(value)) return "none";
  const [whole, power] = value.toPrecision(4).split("e");
  const short = whole.includes(".") ? whole.replace(/\.?0+$/, "") : whole;
  return power ? `${short}e${power}` : short;
}

export function percent(value: number): string {
  return Number.isFinite(value) ? `${(100 * value).toFixed(value > 0 && value < 0.1 ? 1 : 0)}\u202f%` : "none";
}
