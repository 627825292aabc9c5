/** Which tick is shown, and how it goes on: at a multiple of real time, in steps, or by a jump. */

export const RATES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
const PICTURES_PER_SECOND = 60;
const AHEAD_SECONDS = 1; // so far before they are shown rows are fetched
const NEWEST_TICKS = 64; // that may come while the rows before them are fetched
const HISTORY_TICKS = 500; // of what goes on no more come at once: those were there before anybody looked
const FRAME_SECONDS_MAX = 0.1; // after a pause of the browser the run does not leap

export class Playback {
  private position = 0; // ticks, with a fraction
  private target: number | null = null; // a jump to what is not known yet
  known = 0;
  over = false;
  playing = false;
  following = false; // stays with the newest tick of a run that goes on
  rate = 1;

  constructor(
    private readonly tickSeconds: number,
    private readonly ready: (tick: number, ahead: number, every: number) => boolean,
    private readonly changed: () => void,
    private readonly wanted: (tick: number) => void,
    private readonly ofTicks: number | null,
  ) {}

  get tick(): number {
    return Math.floor(this.position / this.every) * this.every;
  }

  /** The tick that was asked for, where it is not known yet. */
  get sought(): number {
    return this.target ?? this.tick;
  }

  /** Only every so many ticks are shown, a power of two: one, but where a picture comes later than the next tick. */
  get every(): number {
    const ticks = this.rate / this.tickSeconds / PICTURES_PER_SECOND;
    return this.playing && this.position < this.known ? 2 ** Math.max(0, Math.floor(Math.log2(ticks))) : 1;
  }

  /** Whether the run was seen to its end, or has not begun. */
  get seen(): boolean {
    return (this.over && this.tick >= this.known) || (!this.playing && this.tick === 0);
  }

  /** Whether other ticks are shown without being asked for. */
  get moving(): boolean {
    return this.playing || this.following;
  }

  /** Goes on by the seconds since the last picture; waits where the next rows are not here yet. */
  advance(seconds: number): void {
    if (this.following) this.position = this.newest();
    if (!this.playing) return;
    const ticks = (Math.min(seconds, FRAME_SECONDS_MAX) * this.rate) / this.tickSeconds;
    const next = Math.min(this.position + ticks, this.known);
    const { every } = this;
    if (!this.ready(Math.floor(next / every) * every, (AHEAD_SECONDS * this.rate) / this.tickSeconds, every)) return;
    this.position = next;
    this.wanted(Math.ceil(next + 2 * ticks + this.rate / this.tickSeconds));
    if (this.over && this.tick >= this.known) this.pause();
  }

  /** The newest tick whose row is here, if one of the last; what is newer is asked for. */
  private newest(): number {
    const least = Math.max(this.position, this.known - NEWEST_TICKS);
    for (let tick = this.known; tick > least; tick--) if (this.ready(tick, 0, 1)) return tick;
    return this.position;
  }

  play(): void {
    this.target = null;
    this.following = false;
    if (this.over && this.tick >= this.known) this.position = 0;
    this.playing = true;
    this.wanted(this.tick + 1);
    this.changed();
  }

  pause(): void {
    this.position = this.tick;
    this.playing = false;
    this.following = false;
    this.changed();
  }

  toggle(): void {
    if (this.moving) this.pause();
    else this.play();
  }

  step(ticks: number): void {
    this.pause();
    this.jump(this.tick + ticks);
  }

  jump(tick: number): void {
    this.following = false;
    this.wanted(tick);
    this.target = tick > this.known && !this.over ? Math.round(tick) : null;
    this.position = Math.min(Math.max(0, Math.round(tick)), this.known);
    this.changed();
  }

  /** Goes to a tick of what has begun anew, and on from there if it was playing. */
  resume(tick: number, playing: boolean): void {
    this.jump(tick);
    this.playing = playing;
  }

  /** Goes to the newest tick, and stays with it while the run goes on. */
  end(): void {
    this.target = null;
    this.wanted(this.ofTicks ?? this.known + 1);
    this.position = this.known;
    this.playing = false;
    this.following = !this.over;
    this.changed();
  }

  faster(steps: number): void {
    const place = RATES.indexOf(this.rate);
    this.rate = RATES[Math.min(RATES.length - 1, Math.max(0, place + steps))];
    this.changed();
  }

  /** Another run, from its beginning. */
  restart(): void {
    this.position = 0;
    this.target = null;
    this.known = 0;
    this.over = false;
    this.following = false;
    this.changed();
  }

  /** More is known of the run. */
  grown(known: number, over: boolean): void {
    const isHistory = !this.known || known - this.known > HISTORY_TICKS;
    if (this.following && isHistory) this.position = known;
    this.known = known;
    this.over = over;
    if (this.following && over) this.end();
    if (this.target !== null) this.position = Math.min(this.target, known);
    if (over || (this.target ?? 0) <= known) this.target = null;
    this.changed();
  }
}
