/** What the page and the worker say to each other. */

export interface Finding {
  from: number;
  to: number;
  line: number;
  severity: "error" | "warning";
  code: string;
  message: string;
  hint: string;
}

export interface Node {
  id: string;
  name: string;
  noun: "skill" | "sensor" | "actuator" | "memory";
  about: string;
}

export interface Edge {
  from: string;
  to: string;
  verb: "reads" | "drives" | "influences";
  said: string;
}

export interface Hierarchy {
  master: string;
  nodes: Node[];
  edges: Edge[];
}

/** What there is to say of a text: no hierarchy where it does not compile, no tidy text where a line cannot be read. */
export interface Answer {
  findings: Finding[];
  hierarchy: Hierarchy | null;
  tidy: string | null;
}

export type FromWorker =
  | { kind: "loaded"; share: number }
  | { kind: "ready" }
  | { kind: "answer"; text: string; answer: Answer }
  | { kind: "failed"; message: string };
