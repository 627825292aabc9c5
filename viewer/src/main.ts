/** The page of mindc view: takes in what is said, and shows it. */

import { type About, connect, type Frame, type Said, type Send } from "./protocol";
import { element } from "./elements";
import { openFile } from "./file";
import { Trainings } from "./trainings";
import { View } from "./view";

let view: View | undefined;
let untouched: HTMLElement | undefined; // the page before anything was shown
const trainings = new Trainings();
const follows = { newest: true };

function said(message: Said, send: Send): void {
  if (message.say === "learnt") trainings.hear(message);
  if (message.say === "about") show(message, send);
  else view?.said(message);
}

/** Shows a run: in the place of one of the same shape, or in a new page. */
function show(about: About, send: Send): void {
  if (view?.restart(about)) return;
  view?.leave();
  if (about.training) {
    const fresh = (untouched ??= document.body.cloneNode(true) as HTMLElement).cloneNode(true) as HTMLElement;
    if (view) document.body.replaceWith(fresh);
  }
  view = new View(about, send, trainings, follows);
}

function closed(reason: string): void {
  element("state").textContent = view ? `disconnected: ${reason}` : `cannot connect: ${reason}`;
  element("state").classList.add("alarm");
}

const listener = { said: (message: Said) => said(message, send), frame: (frame: Frame) => view?.frame(frame), closed };
const send: Send = openFile(listener) ?? connect(listener);
