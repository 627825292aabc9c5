/** Elements and lines of SVG. */

const SVG = "http://www.w3.org/2000/svg";

/** A line through points, round where it bends. */
export function smooth(points: { x: number; y: number }[]): string {
  const at = ({ x, y }: { x: number; y: number }) => `${x.toFixed(1)} ${y.toFixed(1)}`;
  if (points.length < 3) return points.map((point, place) => (place ? "L" : "M") + at(point)).join("");
  let line = `M${at(points[0])}`;
  for (let place = 1; place < points.length - 1; place++) {
    const [point, next] = [points[place], points[place + 1]];
    const end = place === points.length - 2 ? next : { x: (point.x + next.x) / 2, y: (point.y + next.y) / 2 };
    line += `Q${at(point)} ${at(end)}`;
  }
  return line;
}

/** An element with its attributes. */
export function make(name: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}
