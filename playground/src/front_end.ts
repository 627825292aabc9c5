/** Asks the worker about a text, one at a time: while it looks at one, only the latest of those that follow is kept. */

import type { Answer, FromWorker } from "./protocol";

export interface Listener {
  loaded(share: number): void;
  ready(): void;
  answered(text: string, answer: Answer): void;
  failed(message: string): void;
}

export class FrontEnd {
  private readonly worker = new Worker("worker.js", { type: "module" });
  private busy = false;
  private next: string | null = null;

  constructor(private readonly listener: Listener) {
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    this.worker.onerror = (event) => listener.failed(event.message || "The worker does not start.");
  }

  ask(text: string): void {
    if (this.busy) {
      this.next = text;
      return;
    }
    this.busy = true;
    this.worker.postMessage(text);
  }

  private hear(said: FromWorker): void {
    if (said.kind === "loaded") this.listener.loaded(said.share);
    else if (said.kind === "ready") this.listener.ready();
    else {
      this.busy = false;
      if (said.kind === "answer") this.listener.answered(said.text, said.answer);
      else this.listener.failed(said.message);
      const next = this.next;
      this.next = null;
      if (next !== null) this.ask(next);
    }
  }
}
