/** Rows that were asked for and came: what the page shows of a tick stands in its row, and nowhere else. */

import { Track } from "./track";
import { type About, type Column, type Frame, HEADER_BYTES, type Send } from "./protocol";

export interface Row {
  tick: number;
  doubles: Float64Array;
  singles: Float32Array;
}

/** What stands in a column of a row; NaN where there is no such column. */
export function valueAt(row: Row, column: Column | null): number {
  if (!column) return NaN;
  return column[0] === 0 ? row.doubles[column[1]] : row.singles[column[1]];
}

/** Values of some columns at evenly spaced ticks. */
export interface Series {
  ticks: number[];
  values: number[][];
}

/** Rows that stand one after the other. */
interface Chunk {
  first: number;
  rows: number;
  doubles: Float64Array;
  singles: Float32Array;
}

const CHUNK_BYTES = 1 << 20;
const CHUNK_ROWS_MIN = 8;
const CHUNK_ROWS_MAX = 128; // what flows is computed for each of them: a jump waits for one chunk
const KEPT_BYTES = 96 << 20;
const CHUNKS_AHEAD_MAX = 6;

const REFUSED_MILLISECONDS = 2000; // after which the same is asked again

/** What is done with an answer, and instead of one that was refused. */
interface Awaited {
  came(frame: Frame): void;
  again(): void;
}

let asked = 0; // over all runs that are seen one after the other: answers about the last are nobody's

export class Rows {
  readonly track: Track;
  private readonly chunks = new Map<string, Chunk>(); // by how many ticks are between rows, and their place
  private readonly awaited = new Set<string>(); // chunks that were asked for
  private readonly answers = new Map<number, Awaited>();
  private readonly chunkRows: number;
  private readonly keptChunks: number;
  known = -1;

  constructor(
    private readonly about: About,
    private readonly fork: number,
    private readonly send: Send,
    private readonly changed: () => void,
  ) {
    const bytes = Math.max(1, 8 * about.doubles + 4 * about.singles);
    const rows = 2 ** Math.floor(Math.log2(CHUNK_BYTES / bytes));
    this.track = new Track(about, (...asked) => this.series(...asked), () => this.known, changed);
    this.chunkRows = Math.min(CHUNK_ROWS_MAX, Math.max(CHUNK_ROWS_MIN, rows));
    this.keptChunks = Math.max(2 * CHUNKS_AHEAD_MAX, Math.floor(KEPT_BYTES / (bytes * this.chunkRows)));
  }

  /** Another run of the same shape. */
  restart(): void {
    for (const kept of [this.chunks, this.awaited, this.answers]) kept.clear();
    this.track.restart();
    this.known = -1;
  }

  /**
   * The row of a tick, if it is here; else it is asked for, and so are so many ticks after it. Who shows only every so
   * many ticks asks for those alone.
   */
  row(tick: number, ahead = 0, every = 1): Row | undefined {
    const ticks = this.chunkRows * every;
    const first = Math.floor(tick / ticks);
    const last = Math.min(Math.floor((tick + ahead) / ticks), first + CHUNKS_AHEAD_MAX);
    const chunk = this.chunk(first, every);
    for (let place = first + 1; place <= last; place++) this.chunk(place, every);
    const row = chunk ? (tick - chunk.first) / every : 0;
    return chunk && row < chunk.rows ? this.rowOf(chunk, row, tick) : undefined;
  }

  /** Some columns from a tick to another, both included, no more than about `most` values of each. */
  series(columns: Column[], from: number, to: number, most: number, then: (series: Series) => void): void {
    const every = Math.max(1, Math.ceil((to - from + 1) / most));
    const found: Series = { ticks: [], values: columns.map(() => []) };
    const next = (first: number) => {
      const came = (frame: Frame) => {
        const values = new Float64Array(frame.blocks, HEADER_BYTES);
        for (let row = 0; row < frame.rows; row++) found.ticks.push(first + row * every);
        found.values.forEach((of, place) => of.push(...values.subarray(place * frame.rows, (place + 1) * frame.rows)));
        const after = first + frame.rows * every;
        if (frame.rows && after <= to) next(after);
        else then(found);
      };
      this.ask({ say: "columns", columns, from: first, to: to + 1, every }, { came, again: () => next(first) });
    };
    next(from);
  }

  /** Takes in what came of this fork. */
  add(frame: Frame): void {
    const answer = this.answers.get(frame.ask);
    this.answers.delete(frame.ask);
    answer?.came(frame);
  }

  /** What was asked is not answered; it is asked again later, if it is still wanted then. */
  refused(ask: number): void {
    const { answers } = this;
    const answer = answers.get(ask);
    if (!answer) return;
    setTimeout(() => {
      if (answers.delete(ask)) answer.again(); // else another run is seen now
    }, REFUSED_MILLISECONDS);
  }

  private ask(message: object, answer: Awaited): void {
    this.answers.set(++asked, answer);
    this.send({ ...message, fork: this.fork, ask: asked });
  }

  private chunk(place: number, every: number): Chunk | undefined {
    const key = `${every}/${place}`;
    const found = this.chunks.get(key);
    const first = place * this.chunkRows * every;
    const to = first + this.chunkRows * every;
    const from = first + (found?.rows ?? 0) * every;
    if (from <= Math.min(this.known, to - 1) && !this.awaited.has(key)) {
      this.awaited.add(key);
      const again = () => this.awaited.delete(key) && this.changed();
      this.ask({ say: "rows", from, to, every }, { came: (frame) => this.keep(key, frame), again });
    }
    return found;
  }

  private keep(key: string, frame: Frame): void {
    this.awaited.delete(key);
    const found = this.chunks.get(key);
    const came = this.chunkOf(frame);
    this.chunks.delete(key); // a Map keeps the order of setting: the oldest goes first
    this.chunks.set(key, found ? joined(found, came) : came);
    if (this.chunks.size > this.keptChunks) this.chunks.delete(this.chunks.keys().next().value!);
    this.changed();
  }

  private chunkOf({ first, rows, blocks }: Frame): Chunk {
    const doubles = rows * this.about.doubles;
    return {
      first,
      rows,
      doubles: new Float64Array(blocks, HEADER_BYTES, doubles),
      singles: new Float32Array(blocks, HEADER_BYTES + 8 * doubles, rows * this.about.singles),
    };
  }

  private rowOf(chunk: Chunk, place: number, tick: number): Row {
    const { doubles, singles } = this.about;
    return {
      tick,
      doubles: chunk.doubles.subarray(place * doubles, (place + 1) * doubles),
      singles: chunk.singles.subarray(place * singles, (place + 1) * singles),
    };
  }
}

function joined(one: Chunk, next: Chunk): Chunk {
  const doubles = new Float64Array(one.doubles.length + next.doubles.length);
  doubles.set(one.doubles);
  doubles.set(next.doubles, one.doubles.length);
  const singles = new Float32Array(one.singles.length + next.singles.length);
  singles.set(one.singles);
  singles.set(next.singles, one.singles.length);
  return { first: one.first, rows: one.rows + next.rows, doubles, singles };
}
