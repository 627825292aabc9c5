/** A run on the page: one clock, and everything that shows a tick of it. */

import { ActiveList } from "./active";
import { Curves } from "./curves";
import { element, svgElement } from "./elements";
import { Drive } from "./drive";
import { Edit } from "./edit";
import { Events } from "./events";
import { Forks } from "./forks";
import { listenToButtons, LIVE, showTitle } from "./header";
import type { Selected } from "./description";
import { Hierarchy } from "./hierarchy";
import { helpRows, listen } from "./keys";
import { keysOf } from "./key_table";
import { Learning } from "./learning";
import { Links } from "./links";
import { shown } from "./names";
import { refusal } from "./notice";
import { Orders } from "./orders";
import { Playback } from "./playback";
import type { About, Frame, Refused, Said, Send, Ticks } from "./protocol";
import { Rows } from "./rows";
import { Selection } from "./selection";
import { shapeOf } from "./shape";
import { Stops } from "./stops";
import { theme, themeSwitch } from "./theme";
import { Timeline } from "./timeline";
import type { Trainings } from "./trainings";
import { Transport } from "./transport";
import { Why } from "./why";
import { Seen } from "./seen";
import { World } from "./world";

const FIRST_TICKS = 1200; // of a run that goes on when it is asked

export class View {
  readonly playback: Playback;
  readonly hierarchy: Hierarchy;
  readonly world: World | null;
  private readonly seen: Seen;
  readonly timeline: Timeline;
  private readonly rows: Rows;
  private readonly active: ActiveList;
  private readonly curves: Curves;
  private readonly why: Why;
  private readonly learning: Learning | null;
  private readonly left = new AbortController();
  private readonly transport: Transport;
  private readonly forks: Forks;
  private readonly edit: Edit;
  private readonly selection: Selection;
  private readonly orders: Orders;
  private readonly happened = new Events();
  private readonly collisions = new Events();
  private readonly stops = new Stops();
  private end = ""; // how it ended, or why it failed
  private failed = "";
  private dirty = true;
  private asked = -1;
  private last = performance.now();

  constructor(
    private readonly about: About,
    private readonly send: Send,
    trainings: Trainings,
    follows: { newest: boolean },
  ) {
    const redraw = () => {
      this.dirty = true;
    };
    const jump = (tick: number) => this.playback.jump(tick);
    this.rows = new Rows(about, 0, send, redraw);
    this.playback = new Playback(about.tick, (tick, ahead, every) => !!this.rows.row(tick, ahead, every), redraw, (tick) => this.want(tick), about.of_ticks);
    this.world = about.world && new World(element<HTMLCanvasElement>("world"), about, about.world, theme(), redraw, (robot) => this.watch(robot));
    this.seen = new Seen(about, send, redraw);
    const shows = { over: (at: Selected, event: PointerEvent) => this.selection.point(at, event), chosen: (at: Selected) => this.choose(at) };
    this.hierarchy = new Hierarchy(svgElement("hierarchy"), element<HTMLCanvasElement>("edges"), about, shows, redraw);
    const search = element<HTMLInputElement>("search");
    this.active = new ActiveList(element("active"), search, element("count"), about, (node) => this.hierarchy.reveal(node));
    const curvesSearch = element<HTMLInputElement>("curves-search");
    this.curves = new Curves(element("curves"), element("curves-choice"), curvesSearch, about, this.rows, theme(), jump);
    this.timeline = new Timeline(element<HTMLCanvasElement>("timeline"), element("hint"), about, theme(), this.happened, this.stops, jump);
    this.why = new Why(element("why"), about, send);
    this.edit = new Edit(element("edit"), about, send, () => this.playback.tick);
    this.selection = new Selection(about, this.why, this.edit, new Links(svgElement("links"), about), () => this.row);
    this.orders = new Orders(element("orders"), about, send);
    new Drive(about, send, this.left.signal);
    this.forks = new Forks(element<HTMLSelectElement>("forks"), about, send, () => this.beside());
    const followed = (newest: boolean) => (follows.newest = newest);
    this.learning = about.training ? new Learning(about, trainings, send, theme(), follows.newest, followed) : null;
    this.transport = new Transport(this.playback, this.timeline, about.tick, about.source in LIVE);
    const parts = { ...this.parts(), follow: () => this.follow(), nextRobot: () => this.nextRobot() };
    showTitle(about);
    listenToButtons(parts);
    const keys = keysOf(parts, () => search.focus(), () => element<HTMLDialogElement>("keys").showModal());
    listen(keys, this.left.signal);
    element("keys-table").replaceChildren(...helpRows(keys));
    themeSwitch(element("theme"), () => this.recolour());
    const sizes = new ResizeObserver(() => this.resize());
    sizes.observe(document.body);
    this.left.signal.addEventListener("abort", () => sizes.disconnect());
    this.want(FIRST_TICKS);
    requestAnimationFrame((now) => this.step(now));
  }

  /** Goes on with another run that differs only in what it comes to; false where it is of another shape. */
  restart(about: About): boolean {
    if (shapeOf(about) !== shapeOf(this.about)) return false;
    const watched = this.watchedIn(about);
    const plays = this.playback.playing || (this.playback.over && this.playback.tick >= this.playback.known);
    const follows = about.source in LIVE && (plays || this.playback.following);
    if (about.world) Object.assign(this.about.world!, about.world);
    Object.assign(this.about, about, { world: this.about.world });
    this.asked = -1;
    for (const part of [this.seen, this.happened, this.collisions, this.rows, this.playback, this.forks, this.curves, this.stops, this.why]) part.restart();
    this.learning?.restarted();
    showTitle(about);
    this.want(FIRST_TICKS);
    if (watched) this.playback.resume(watched.tick, watched.plays);
    else if (follows) this.playback.end();
    else if (plays) this.playback.play();
    return true;
  }

  /** The tick that is shown, and whether it plays on, where this is the same run through another robot. */
  watchedIn({ seed, robot }: About): { tick: number; plays: boolean } | undefined {
    if (seed !== this.about.seed || robot === this.about.robot) return undefined;
    return { tick: this.playback.sought, plays: this.playback.playing };
  }

  /** Asks for the run as another robot of its world has it. */
  private watch(robot: number): void {
    this.send({ say: "watch", robot });
  }

  private nextRobot(): void {
    const { robot, robots } = this.about;
    if (robots > 1) this.watch((robot + 1) % robots);
  }

  /** This page shows something else now. */
  leave(): void {
    this.left.abort();
  }

  said(message: Exclude<Said, About>): void {
    if (message.say === "learnt") this.learning?.show();
    if (message.say === "ticks" && message.fork === 0) this.grown(message);
    else if (message.say === "ticks") this.forks.ticks(message);
    else if (message.say === "fork") this.forks.begun(message);
    else if (message.say === "why") this.why.show(message);
    else if (message.say === "image") this.seen.show(message);
    else if (message.say === "refused") this.refused(message);
  }

  private refused({ why, of, ask }: Refused): void {
    if (of === "why") return this.why.refused(why);
    if (of === "image") return this.seen.refused(why);
    if (ask !== null) for (const rows of [this.rows, this.forks]) rows.refused(ask);
    refusal(why);
  }

  frame(frame: Frame): void {
    if (frame.fork === 0) this.rows.add(frame);
    else this.forks.frame(frame);
  }

  private beside(): void {
    this.curves.compare(this.forks.chosen);
    this.dirty = true;
  }

  private parts() {
    const { playback, timeline, hierarchy, world } = this;
    return { playback, timeline, hierarchy, world };
  }

  follow(): void {
    if (this.world) element("world-follow").setAttribute("aria-pressed", String(this.world.follow()));
    this.dirty = true;
  }

  /** Lets a run go on that does so when it is asked. */
  private want(tick: number): void {
    const to = Math.min(tick, this.about.of_ticks ?? tick);
    if (this.playback?.over || to <= Math.max(this.asked, this.rows.known)) return;
    this.asked = to;
    this.send({ say: "run", to });
    this.forks.want(to);
  }

  private grown({ known, over, ended_by, failed, happened, stops }: Ticks): void {
    this.rows.known = known;
    this.happened.add(happened);
    this.collisions.add(happened.filter(([, event]) => this.about.events[event]?.kind === "collision"));
    this.stops.add(stops);
    this.playback.grown(known, over);
    this.curves.refresh();
    this.end = over ? `${known} ticks${ended_by ? `, ended by ${shown(ended_by)}` : ""}` : "";
    this.failed = failed ? shown(failed, 200) : "";
    element("state").classList.toggle("alarm", !!failed);
  }

  private recolour(): void {
    const colours = theme();
    this.world?.recolour(colours);
    this.curves.recolour(colours);
    this.learning?.recolour(colours);
    this.timeline.recolour(colours);
    this.dirty = true;
  }

  private resize(): void {
    this.world?.resize();
    this.hierarchy.resize();
    this.curves.resize();
    this.learning?.resize();
    this.timeline.resize();
    this.dirty = true;
  }

  private step(now: number): void {
    if (this.left.signal.aborted) return;
    requestAnimationFrame((next) => this.step(next));
    const before = this.playback.tick;
    this.playback.advance((now - this.last) / 1000);
    this.last = now;
    this.stops.between(before, this.playback.tick, this.playback);
    if (!this.forks.chosen) this.learning?.next(this.playback.seen, now);
    if (this.dirty || this.playback.tick !== before) this.draw(now);
    this.why.at(this.playback.tick, 0, now);
  }

  /** The row of the tick that is shown, if it is here. */
  private get row() {
    return this.rows.row(this.playback.tick, 0, this.playback.every);
  }

  private draw(now: number): void {
    const { tick, known, over } = this.playback;
    this.transport.show();
    this.timeline.show(tick, known, over);
    const stop = this.playback.moving ? undefined : this.stops.at(tick);
    element("state").textContent = this.failed || (stop ? `stopped: ${stop}` : this.end);
    this.curves.move(tick);
    const row = this.row;
    if (!row) return;
    const drawn = [this.active.draw(row, now), this.hierarchy.draw(row, now)];
    this.dirty = drawn.includes(false);
    this.world?.draw(row, this.rows, this.collisions, this.forks.chosen);
    this.seen.at(tick, this.forks.chosen);
    this.edit.show(this.playback.playing, tick);
    this.selection.show();
    this.orders.show(row);
    document.body.dataset.tick = String(tick); // the tick whose row is seen
  }

  private choose(selected: Selected): void {
    this.selection.choose(selected);
    this.dirty = true;
  }
}
