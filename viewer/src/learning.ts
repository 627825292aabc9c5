/** How skills are learnt: the scores of each attempt by generation; a click plays the champion of one. */

import uPlot from "uplot";
import { element, pressed } from "./elements";
import { digits, shown } from "./names";
import type { About, Playing, Send } from "./protocol";
import type { Theme } from "./theme";
import type { Training, Trainings } from "./trainings";

const SHOWN_MILLISECONDS = 15_000; // at least, before the champion of a newer generation plays

const BEGUN = /^\d{8}T(\d\d)(\d\d)(\d\d)Z.*/; // the name of a run's folder

/** A point of a curve that can be clicked. */
interface Point {
  attempt: number;
  generation: number;
  score: number;
}

export class Learning {
  private plot: uPlot | undefined;
  private drawn = "";
  private chosen: number;
  private points: Point[] = [];
  private since = performance.now();
  private asked = "";
  private readonly place = element("learning");
  private readonly cursor = document.createElement("div");

  constructor(
    private readonly about: About,
    private readonly trainings: Trainings,
    private readonly send: Send,
    private theme: Theme,
    private following: boolean,
    private readonly followed: (following: boolean) => void,
  ) {
    this.cursor.className = "cursor";
    this.chosen = about.training?.run ?? 0;
    const shows = (learning: boolean) => {
      element("learning-pane").hidden = !learning;
      element("curves-pane").hidden = learning;
      if (learning) this.resize();
    };
    pressed("show-values", () => shows(false));
    pressed("show-learning", () => shows(true));
    pressed("follow-newest", () => this.follow(!this.following));
    element("show-learning").hidden = false;
    element<HTMLButtonElement>("follow-newest").disabled = !about.edits;
    this.follow(following && about.edits);
    shows(true);
    this.show();
  }

  /** Another champion plays. */
  restarted(): void {
    this.since = performance.now();
    this.chosen = this.playing.run;
    this.show();
  }

  recolour(theme: Theme): void {
    this.theme = theme;
    this.drawn = "";
    this.show();
  }

  resize(): void {
    if (element("learning-pane").hidden) return;
    this.plot?.setSize(this.size());
    this.mark();
  }

  /** Asks for the newest champion if it is followed, and what plays has been seen. */
  next(seen: boolean, now: number): void {
    const newest = this.trainings.newest;
    const { run, attempt, since } = this.playing;
    if (!this.following || !newest[1] || newest.join() === [run, attempt, since].join()) return;
    if (newest.join() !== this.asked && (seen || now - this.since > SHOWN_MILLISECONDS)) {
      this.asked = newest.join();
      this.play(...newest);
    }
  }

  /** Shows what has come. */
  show(): void {
    const training = this.trainings.runs[this.chosen];
    this.list();
    if (!training) return;
    const attempts = [...new Set(training.generations.map(([attempt]) => attempt))];
    const last = training.generations.reduce((most, [, generation]) => Math.max(most, generation), 0);
    const columns = attempts.flatMap((attempt) => columnsOf(training, attempt, last));
    const drawn = `${this.chosen}/${attempts.length}`;
    if (drawn !== this.drawn) this.rebuild(attempts);
    this.drawn = drawn;
    this.plot!.setData([Array.from({ length: last }, (_, place) => place + 1), ...columns]);
    this.points = pointsOf(training);
    this.mark();
  }

  private get playing(): Playing {
    return this.about.training!;
  }

  private follow(following: boolean): void {
    this.following = following;
    this.followed(following);
    element("follow-newest").setAttribute("aria-pressed", String(following));
  }

  private play(run: number, attempt: number, generation: number): void {
    this.send({ say: "champion", run, attempt, generation, seed: this.about.seed });
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(100, this.place.clientWidth), height: Math.max(60, this.place.clientHeight) };
  }

  private rebuild(attempts: number[]): void {
    this.plot?.destroy();
    const axis = { stroke: this.theme.faint, grid: { stroke: this.theme.grid, width: 1 }, ticks: { show: false }, font: "12px system-ui" };
    const options: uPlot.Options = {
      ...this.size(),
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false } },
      axes: [{ ...axis, size: 26, gap: 3 }, { ...axis, size: 52, gap: 3 }],
      hooks: { draw: [() => this.mark()] },
      series: [{}, ...attempts.flatMap((attempt) => this.lines(attempt))],
    };
    this.plot = new uPlot(options, [[], ...attempts.flatMap(() => [[], [], []])] as uPlot.AlignedData, this.place);
    this.plot.over.append(this.cursor);
    this.plot.over.addEventListener("click", (event) => this.clicked(event));
  }

  /** The best of each generation, thin; the champion on fresh layouts; the verdict in the end. */
  private lines(attempt: number): uPlot.Series[] {
    const stroke = this.colour(attempt);
    return [
      { stroke, width: 1, alpha: 0.35, points: { show: false } },
      { stroke, width: 2, spanGaps: true, points: { show: true, size: 6, fill: stroke } },
      { stroke, width: 0, points: { show: true, size: 12, width: 2, fill: this.theme.floor } },
    ];
  }

  private colour(attempt: number): string {
    return this.theme.skills[(attempt - 1) % this.theme.skills.length];
  }

  /** Puts the cursor on the generation whose champion plays, and says who it is. */
  private mark(): void {
    const { run, attempt, generation, since, score } = this.playing;
    const left = this.plot?.valToPos(generation, "x") ?? -1;
    this.cursor.style.transform = `translateX(${left}px)`;
    this.cursor.hidden = run !== this.chosen || !(left >= 0);
    const name = shown(this.trainings.runs[run]?.name ?? "", 40);
    const found = since === generation ? "" : `, found in generation ${since}`;
    const scored = score === null ? "" : `: ${digits(score)} on fresh layouts`;
    element("learning-now").textContent = `${name}: the champion of attempt ${attempt}, generation ${generation}${found}, plays${scored}.`;
  }

  private clicked(event: MouseEvent): void {
    const { left, top } = this.plot!.over.getBoundingClientRect();
    const far = ({ generation, score }: Point) =>
      Math.hypot(this.plot!.valToPos(generation, "x") - (event.clientX - left), this.plot!.valToPos(score, "y") - (event.clientY - top));
    const nearest = this.points.reduce<Point | null>((best, each) => (best && far(best) <= far(each) ? best : each), null);
    if (!nearest || !this.about.edits) return;
    this.follow(false);
    this.play(this.chosen, nearest.attempt, nearest.generation);
  }

  private list(): void {
    const items = this.trainings.runs.map((run, number) => this.item(run, number));
    element("learning-runs").replaceChildren(...items.filter((item) => item !== null));
  }

  private item({ name, folder, generations }: Training, number: number): HTMLLIElement {
    const [item, label, radio, text, kind] = ["li", "label", "input", "span", "span"].map((tag) => document.createElement(tag));
    const input = radio as HTMLInputElement;
    input.type = "radio";
    input.name = "training";
    input.checked = number === this.chosen;
    input.addEventListener("change", () => {
      this.chosen = number;
      this.show();
    });
    text.className = "name";
    const alone = this.trainings.runs.filter((run) => run.name === name).length === 1;
    text.textContent = shown(alone ? name : `${name} ${folder.replace(BEGUN, "$1:$2:$3")}`, 60);
    text.title = shown(`${name} ${folder}`, 200);
    kind.className = "kind";
    kind.textContent = String(generations.length);
    label.append(input, text, kind);
    item.append(label);
    return item as HTMLLIElement;
  }
}

/** Best, champion on fresh layouts and verdict of an attempt, by generation. */
function columnsOf({ generations }: Training, attempt: number, last: number): (number | null)[][] {
  const columns = [0, 1, 2].map(() => Array<number | null>(last).fill(null));
  for (const [of, generation, ...scores] of generations) {
    if (of === attempt) scores.forEach((score, place) => (columns[place][generation - 1] = score));
  }
  return columns;
}

/** What can be clicked: where the champion was tried. */
function pointsOf({ generations }: Training): Point[] {
  return generations.flatMap(([attempt, generation, best, tried]) =>
    [best, tried].flatMap((score) => (score === null ? [] : [{ attempt, generation, score }])),
  );
}
