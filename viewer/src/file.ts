/** A page with its recording in it, opened from a disk: the same questions, answered without a server. */

import { type About, COLUMNS_KIND, type Drawn, type Frame, HEADER_BYTES, type Listener, type Refused, ROWS_KIND, type Send, type Ticks } from "./protocol";

interface Recording {
  about: About;
  ticks: Ticks;
  rows: number;
  images: Images | null; // of a run in an environment
}

/** Those after the ticks 0, `every`, 2 · `every` …; `why` says what is wrong where there are none. */
interface Images {
  every: number;
  images: string[];
  why: string;
}

interface Question {
  say: string;
  tick: number;
  from: number;
  to: number;
  every: number;
  ask: number;
  columns: [block: number, index: number][];
}

/** The columns of both blocks, one after the other. */
type Blocks = (Float64Array | Float32Array)[][];

/** Answers from the file that this page is, or null where it is none. */
export function openFile(listener: Listener): Send | null {
  const [data, rows] = ["recording", "rows"].map((id) => document.getElementById(id));
  if (!data || !rows) return null;
  const recording = JSON.parse(data.textContent ?? "") as Recording;
  const { about, ticks } = recording;
  let blocks: Blocks | undefined;
  void inflated(rows.textContent ?? "").then(
    (bytes) => {
      blocks = columnsOf(bytes, recording);
      rows.remove();
      listener.said(about);
      listener.said(ticks);
    },
    () => listener.closed("this file is damaged, or this browser is too old to read it"),
  );
  return (message) => {
    const question = message as Question;
    if (question.say === "rows" && blocks) listener.frame(rowsFrame(blocks, question, recording.rows));
    else if (question.say === "columns" && blocks) listener.frame(columnsFrame(blocks, question, recording.rows));
    else if (question.say === "image" && recording.images) listener.said(imageSaid(recording.images, question));
    else if (question.say !== "run") listener.said(refused("a file cannot compute this: open the run with mindc view", question));
  };
}

function refused(why: string, { say, ask }: Question): Refused {
  return { say: "refused", why, of: say, ask: ask ?? null };
}

function imageSaid({ every, images, why }: Images, question: Question): Drawn | Refused {
  const number = Math.floor(question.tick / every);
  return number < images.length ? { say: "image", fork: 0, tick: number * every, image: images[number] } : refused(why, question);
}

async function inflated(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

function columnsOf(bytes: ArrayBuffer, { about, rows }: Recording): Blocks {
  const all = new Uint8Array(bytes);
  let at = 0;
  const column = (size: number): ArrayBuffer => {
    at += size * rows;
    return restored(all.subarray(at - size * rows, at), size, rows);
  };
  const doubles = Array.from({ length: about.doubles }, () => new Float64Array(column(8)));
  const singles = Array.from({ length: about.singles }, () => new Float32Array(column(4)));
  if (at !== all.length) throw new Error("another length");
  return [doubles, singles];
}

/** The numbers of a column, from the differences of each byte to that of the number before it. */
function restored(differences: Uint8Array, size: number, rows: number): ArrayBuffer {
  const numbers = new Uint8Array(size * rows);
  for (let place = 0; place < size; place++) {
    let byte = 0;
    for (let row = 0; row < rows; row++) {
      byte ^= differences[place * rows + row];
      numbers[size * row + place] = byte;
    }
  }
  return numbers.buffer;
}

function asked({ from, to, every }: Question, rows: number): number[] {
  const found = [];
  for (let tick = from; tick < Math.min(to, rows); tick += every) found.push(tick);
  return found;
}

function frame(kind: number, question: Question, rows: number, blocks: ArrayBuffer): Frame {
  return { kind, fork: 0, first: question.from, every: question.every, rows, ask: question.ask, blocks };
}

function rowsFrame([doubles, singles]: Blocks, question: Question, rows: number): Frame {
  const ticks = asked(question, rows);
  const bytes = new ArrayBuffer(HEADER_BYTES + ticks.length * (8 * doubles.length + 4 * singles.length));
  const wide = new Float64Array(bytes, HEADER_BYTES, ticks.length * doubles.length);
  const narrow = new Float32Array(bytes, HEADER_BYTES + wide.byteLength, ticks.length * singles.length);
  ticks.forEach((tick, row) => {
    doubles.forEach((column, i) => (wide[row * doubles.length + i] = column[tick]));
    singles.forEach((column, i) => (narrow[row * singles.length + i] = column[tick]));
  });
  return frame(ROWS_KIND, question, ticks.length, bytes);
}

function columnsFrame(blocks: Blocks, question: Question, rows: number): Frame {
  const ticks = asked(question, rows);
  const bytes = new ArrayBuffer(HEADER_BYTES + 8 * ticks.length * question.columns.length);
  const values = new Float64Array(bytes, HEADER_BYTES);
  question.columns.forEach(([block, index], place) => {
    const column = blocks[block][index];
    ticks.forEach((tick, row) => (values[place * ticks.length + row] = column[tick]));
  });
  return frame(COLUMNS_KIND, question, ticks.length, bytes);
}
