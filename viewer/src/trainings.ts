/** Trainings that are seen while they go on: what was said of each. */

import type { Generation, Learnt } from "./protocol";

export interface Training {
  name: string;
  folder: string;
  generations: Generation[];
}

export class Trainings {
  readonly runs: Training[] = [];
  newest: [run: number, attempt: number, generation: number] = [0, 0, 0];

  /** All is told once more, through another connection. */
  restart(): void {
    this.runs.length = 0;
  }

  hear(said: Learnt): void {
    const before = this.runs[said.run]?.generations ?? [];
    this.runs[said.run] = {
      name: said.name,
      folder: said.folder,
      generations: [...before, ...said.generations],
    };
    this.newest = said.newest;
  }
}
