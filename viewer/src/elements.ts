/** The elements of index.html by their names. */

export function element<Kind extends HTMLElement = HTMLElement>(name: string): Kind {
  const found = document.getElementById(name);
  if (!found) throw new Error(`index.html has no ${name}`);
  return found as Kind;
}

export function svgElement(name: string): SVGSVGElement {
  return element(name) as unknown as SVGSVGElement;
}

/** Calls back when the button of a name is pressed. */
export function pressed(name: string, act: () => void): void {
  element(name).addEventListener("click", act);
}
