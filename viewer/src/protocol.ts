/** What the page and the server say to each other: docs/decisions/a-run-is-a-recording.md. */

/** A place in a row: block 0 has the doubles, block 1 the singles. */
export type Column = [block: number, index: number];
type Point = [x: number, y: number];

export interface Node {
  name: string;
  kind: "sensor" | "skill" | "actuator" | "memory";
  says: string;
  columns: Column[];
  master: boolean;
  chooses: boolean; // sends one of its influences, and no other
  promises: Promised[];
}

/** Its columns: what became of it in a tick, then in how many so far it was held, broken by its skill, and by those above. */
export interface Promised {
  text: string;
  columns: Column[];
}

/** A sensor that is what somebody says: one of so many choices, or a number where there are none. */
export interface Order {
  name: string;
  node: number;
  choices: number;
  low: number;
  high: number;
}

/** An actuator or a skill that a hand holds. */
export interface Grip {
  name: string;
  neutral: number; // what it says where nothing is pushed
  role: "left" | "right" | "ahead" | "turn" | ""; // of what moves the robot
}

/** From a node to a node; what edge number i transmits is the i-th column of the group `flow`. */
export interface Edge {
  from: number;
  to: number;
  text: string;
  over: number[]; // the nodes for which alone it counts; none where for all
}

/** The network of a skill whose links are learnt, too: what each of its nodes reads. */
export interface Grown {
  skill: string;
  nodes: { name: string; role: "bias" | "reading" | "neuron" | "output" }[];
  links: [from: number, to: number, weight: number][];
}

export interface Curve {
  name: string;
  group: "reading" | "influence" | "command" | "reward" | "world";
  column: Column;
  circular: boolean; // a direction, which goes round: 1 is 0
}

export interface Robot {
  radius: number;
  outline: Point[];
  front: number;
  side: number;
  axles: number;
  rays: { angle: number; rim: number; reach: number; column: Column; turned: Column | null; name: string; sees: boolean }[];
  spots: { x: number; y: number; column: Column }[];
  switches: { angle: number; width: number; column: Column }[];
  bearings: { name: string; column: Column; turned: Column | null }[];
  claw: Column | null;
  steering: { column: Column; turn: number } | null;
  lamps: Column[];
  jets: { at: Point; way: Point; column: Column }[];
}

export interface Thing {
  name: string;
  kind: string;
  shape: "disc" | "square" | "area";
  light: string;
  dark: string;
  robot: number | null; // which one it is, if it is one
}

export interface World {
  arena: [halfX: number, halfY: number] | null;
  boxes: [x: number, y: number, halfX: number, halfY: number][];
  doors: number[]; // which of the boxes may open
  things: Thing[];
  robot: Robot;
}

type Group = [block: number, first: number, count: number];

export interface About {
  say: "about";
  title: string;
  task: string | null;
  master: string;
  source: "simulation" | "recording" | "robot" | "training" | "environment" | "driven";
  training?: Playing;
  seed: string | null;
  robot: number; // through which one the run is seen
  robots: number; // of how many
  edits: boolean;
  orders: Order[]; // that whoever sees this may say
  drive: Grip[]; // that whoever sees this may drive
  tick: number; // seconds
  of_ticks: number | null;
  doubles: number;
  singles: number;
  columns: Record<string, Group>;
  curves: Curve[];
  nodes: Node[];
  edges: Edge[];
  reads: [from: number, to: number][];
  links: Grown[];
  events: { text: string; kind: string }[];
  rewards: string[];
  ends: string[];
  world: World | null;
  drawn: boolean; // by an environment, a tick when it is asked for
}

/** Whose champion plays: of a generation, found in generation `since`, with its score on fresh layouts. */
export interface Playing {
  run: number;
  attempt: number;
  generation: number;
  since: number;
  score: number | null;
}

export type Generation = [attempt: number, generation: number, best: number | null, reevaluated: number | null, verdict: number | null];

export interface Learnt {
  say: "learnt";
  run: number;
  name: string;
  folder: string;
  generations: Generation[]; // that have come since the last time
  newest: [run: number, attempt: number, generation: number];
}

export interface Ticks {
  say: "ticks";
  fork: number;
  known: number;
  over: boolean;
  ended_by: string | null;
  failed: string | null;
  happened: [tick: number, event: number][];
  stops: [tick: number, text: string][];
}

export interface Why {
  say: "why";
  fork: number;
  tick: number;
  actuator: number;
  command: number;
  paths: { path: number[]; value: number; influence: number; share: number }[]; // the ten largest
  rest: number; // the share of so many others
  rest_paths: number;
  neutral: number;
  rounding: number;
}

export interface Fork {
  say: "fork";
  fork: number;
  of: number;
  tick: number;
  text: string;
}

export interface Refused {
  say: "refused";
  why: string;
  of: string | null; // what the message said
  ask: number | null;
}

/** What the environment of a run draws of itself after a tick. */
export interface Drawn {
  say: "image";
  fork: number;
  tick: number;
  image: string; // as an address with the data in it
}

export type Said = Learnt | About | Ticks | Why | Fork | Drawn | Refused;

/** What came as bytes: rows of both blocks, or some columns as doubles, every `every` ticks from `first` on. */
export interface Frame {
  kind: number;
  fork: number;
  first: number;
  every: number;
  rows: number;
  ask: number;
  blocks: ArrayBuffer;
}

/** Where messages go to, and where what is said arrives. */
export type Send = (message: object) => void;
export interface Listener {
  said(said: Said): void;
  frame(frame: Frame): void;
  closed(reason: string): void;
}

const HEADER_WORDS = 6; // u32: kind, fork, first tick, every, rows, ask
export const HEADER_BYTES = 4 * HEADER_WORDS;
export const ROWS_KIND = 1;
export const COLUMNS_KIND = 2;

/** A message of bytes, its header read. */
export function frameOf(bytes: ArrayBuffer): Frame {
  const [kind, fork, first, every, rows, ask] = new Uint32Array(bytes, 0, HEADER_WORDS);
  return { kind, fork, first, every, rows, ask, blocks: bytes };
}

/** The address of a column of a group, or null where this recording has none. */
export function columnOf(about: About, group: string, number = 0): Column | null {
  const found = about.columns[group];
  return found && number < found[2] ? [found[0], found[1] + number] : null;
}
