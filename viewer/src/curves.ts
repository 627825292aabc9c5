/** Curves over time: of any reading, influence, command or reward line that was chosen; the cursor is the tick that is shown. */

import uPlot from "uplot";
import { digits, shown } from "./names";
import type { Beside } from "./forks";
import type { About, Column, Curve } from "./protocol";
import { rounds } from "./rounds";
import type { Rows, Series } from "./rows";
import type { Theme } from "./theme";

const POINTS_PER_PIXEL = 1.5;
const CHOSEN_MAX = 8; // as many as there are colours
const CHOSEN_AT_FIRST = 3;
const REFRESH_MILLISECONDS = 400;
const LISTED_MAX = 200;
const SUMS = ["reward", "world"]; // groups that are not between 0 and 1

export class Curves {
  private readonly chosen: number[];
  private plot: uPlot | undefined;
  private series: Series = { ticks: [], values: [] };
  private other: Series = { ticks: [], values: [] }; // of the run beside it, at the same ticks
  private beside: Beside | undefined;
  private readonly cursor = document.createElement("div");
  private tick = 0;
  private span: [number, number] | null = null; // the ticks that were zoomed into
  private timer: ReturnType<typeof setTimeout> | undefined;
  private fetching = false;
  private stale = false;

  constructor(
    private readonly place: HTMLElement,
    private readonly list: HTMLElement,
    private readonly search: HTMLInputElement,
    private readonly about: About,
    private readonly rows: Rows,
    private theme: Theme,
    private readonly jump: (tick: number) => void,
  ) {
    this.cursor.className = "cursor";
    const [block, from, count] = about.columns.sent ?? [0, 0, 0]; // the commands again, but where the robot was stopped
    const isSent = ([of, index]: Column) => of === block && index >= from && index < from + count;
    const begins = ({ group, column }: Curve, wanted: string) => group === wanted && !isSent(column);
    const first = (group: string) => [...about.curves.keys()].filter((curve) => begins(about.curves[curve], group));
    this.chosen = [...first("command"), ...first("influence")].slice(0, CHOSEN_AT_FIRST);
    search.addEventListener("input", () => this.fill());
    this.fill();
    this.rebuild();
  }

  recolour(theme: Theme): void {
    this.theme = theme;
    this.fill();
    this.rebuild();
  }

  resize(): void {
    this.plot?.setSize(this.size());
    this.move(this.tick);
  }

  /** More of the run is known, or another part of it is to be seen. */
  refresh(): void {
    this.stale = true;
    this.timer ??= setTimeout(() => {
      this.timer = undefined;
      this.fetch();
    }, REFRESH_MILLISECONDS);
  }

  /** Shows the same curves of a run beside this one, dashed; or of none. */
  compare(beside: Beside | undefined): void {
    if (beside !== this.beside) {
      this.beside = beside;
      this.rebuild();
    } else this.refresh();
  }

  /** Another run of the same shape. */
  restart(): void {
    this.fetching = false;
    this.span = null;
    this.refresh();
  }

  /** Puts the cursor on a tick. */
  move(tick: number): void {
    this.tick = tick;
    if (!this.plot) return;
    const left = this.plot.valToPos(tick * this.about.tick, "x");
    this.cursor.style.transform = `translateX(${left}px)`;
    this.cursor.hidden = !(left >= 0 && left <= this.plot.over.clientWidth);
  }

  /** Adds a curve, or takes it away. */
  toggle(curve: number): void {
    const place = this.chosen.indexOf(curve);
    if (place >= 0) this.chosen.splice(place, 1);
    else if (this.chosen.length < CHOSEN_MAX) this.chosen.push(curve);
    this.fill();
    this.rebuild();
  }

  /** The curve of a name in a group, if there is one. */
  numberOf(group: Curve["group"], name: string): number {
    return this.about.curves.findIndex((curve) => curve.group === group && curve.name === name);
  }

  private fetch(): void {
    if (this.fetching || !this.stale || this.rows.known < 0 || !this.chosen.length) return;
    this.fetching = true;
    this.stale = false;
    const chosen = [...this.chosen];
    const [from, to] = this.span ?? [0, this.rows.known];
    const most = Math.max(100, Math.round(this.place.clientWidth * POINTS_PER_PIXEL));
    const columns = chosen.map((curve) => this.about.curves[curve].column);
    const span: [number, number] = [Math.max(0, Math.floor(from)), Math.min(this.rows.known, Math.ceil(to))];
    const { beside } = this;
    this.rows.series(columns, ...span, most, (series) => {
      const done = (other: Series) => this.came(chosen, beside, series, other);
      if (beside) beside.rows.series(columns, ...span, most, done);
      else done({ ticks: [], values: [] });
    });
  }

  private came(chosen: number[], beside: Beside | undefined, series: Series, other: Series): void {
    this.fetching = false;
    if (chosen.join() !== this.chosen.join() || beside !== this.beside) return this.refresh();
    this.series = series;
    this.other = other;
    this.show();
    if (this.stale) this.refresh();
  }

  private show(): void {
    if (!this.plot) return;
    const { ticks } = this.series;
    const padded = (of: number[]) => ticks.map((_, place) => (Number.isFinite(of[place]) ? of[place] : null));
    const values = [...this.series.values, ...(this.beside ? this.other.values : [])].map(padded);
    const seconds = this.about.tick;
    this.plot.setData([ticks.map((tick) => tick * seconds), ...values], false);
    const [min, max] = this.span ?? [0, Math.max(1, this.rows.known)];
    this.plot.setScale("x", { min: min * seconds, max: max * seconds });
    this.move(this.tick);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(100, this.place.clientWidth), height: Math.max(60, this.place.clientHeight) };
  }

  private rebuild(): void {
    this.plot?.destroy();
    const axis = { stroke: this.theme.faint, grid: { stroke: this.theme.grid, width: 1 }, ticks: { show: false }, font: "12px system-ui" };
    const sums = this.chosen.some((curve) => SUMS.includes(this.about.curves[curve].group));
    const seconds = (value: number) => `${digits(value)}\u2009s`;
    const options: uPlot.Options = {
      ...this.size(),
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: true, y: false } },
      scales: { x: { time: false }, unit: { range: [0, 1] }, sum: {} },
      axes: [
        { ...axis, size: 26, gap: 3, values: (_, values) => values.map(seconds) },
        { ...axis, scale: "unit", size: 40, gap: 3 },
        ...(sums ? [{ ...axis, scale: "sum", side: 1 as const, size: 52, gap: 3, grid: { show: false } }] : []),
      ],
      series: [{}, ...this.lines(false), ...(this.beside ? this.lines(true) : [])],
      hooks: { setSelect: [(plot) => this.zoomed(plot)] },
    };
    const empty = options.series.slice(1).map(() => [] as number[]);
    this.plot = new uPlot(options, [[], ...empty], this.place);
    this.plot.over.append(this.cursor);
    this.plot.over.addEventListener("click", (event) => this.clicked(event));
    this.plot.over.addEventListener("dblclick", () => this.whole());
    this.stale = true;
    this.fetch();
  }

  private lines(dashed: boolean): uPlot.Series[] {
    return this.chosen.map((curve, place) => this.line(this.about.curves[curve], place, dashed));
  }

  private line({ group, circular }: Curve, place: number, dashed: boolean): uPlot.Series {
    return {
      ...(circular ? { gaps: rounds } : {}),
      ...(dashed ? { dash: [5, 4] } : {}),
      scale: SUMS.includes(group) ? "sum" : "unit",
      stroke: this.theme.skills[place % this.theme.skills.length],
      width: 1.5,
      points: { show: false },
    };
  }

  private zoomed(plot: uPlot): void {
    if (plot.select.width < 4) return;
    this.span = [this.tickAt(plot.select.left), this.tickAt(plot.select.left + plot.select.width)];
    this.refresh();
  }

  private whole(): void {
    this.span = null;
    this.refresh();
  }

  private clicked(event: MouseEvent): void {
    if (!this.plot || this.plot.select.width >= 4) return;
    const { left } = this.plot.over.getBoundingClientRect();
    this.jump(Math.round(this.tickAt(event.clientX - left)));
  }

  private tickAt(left: number): number {
    return this.plot!.posToVal(left, "x") / this.about.tick;
  }

  private fill(): void {
    const searched = this.search.value.trim().toLowerCase();
    const fits = ({ name, group }: Curve) => `${group} ${name}`.toLowerCase().includes(searched);
    const found = [...this.about.curves.keys()].filter((curve) => fits(this.about.curves[curve]));
    const others = found.filter((curve) => !this.chosen.includes(curve)).slice(0, LISTED_MAX);
    this.list.replaceChildren(...[...this.chosen, ...others].map((curve) => this.choice(curve)));
  }

  private choice(number: number): HTMLLIElement {
    const { name, group } = this.about.curves[number];
    const item = document.createElement("li");
    const label = document.createElement("label");
    const box = document.createElement("input");
    const [text, kind] = [document.createElement("span"), document.createElement("span")];
    const place = this.chosen.indexOf(number);
    box.type = "checkbox";
    box.checked = place >= 0;
    box.disabled = place < 0 && this.chosen.length >= CHOSEN_MAX;
    box.dataset.curve = String(number);
    box.addEventListener("change", () => {
      this.toggle(number);
      this.list.querySelector<HTMLElement>(`[data-curve="${number}"]`)?.focus(); // the list is made anew
    });
    if (place >= 0) box.style.accentColor = this.theme.skills[place % this.theme.skills.length];
    text.className = "name";
    text.textContent = shown(name, 80);
    text.title = shown(name, 200);
    kind.className = "kind";
    kind.textContent = group;
    label.append(box, text, kind);
    item.append(label);
    return item;
  }
}
