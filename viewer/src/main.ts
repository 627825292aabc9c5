/** The page of mindc view: takes in what is said, and shows it. */

import { connect } from "./connection";
import { openFile } from "./file";
import { noTrouble, trouble } from "./notice";
import type { About, Frame, Said, Send } from "./protocol";
import { Trainings } from "./trainings";
import { View } from "./view";

let view: View | undefined;
let untouched: HTMLElement | undefined; // the page before anything was shown
let isLost = false; // the connection: what is shown is what was here
const trainings = new Trainings();
const follows = { newest: true };

function said(message: Said, send: Send): void {
  if (message.say === "learnt") trainings.hear(message);
  if (message.say === "about") show(message, send);
  else view?.said(message);
}

/** Shows a run: in the place of one of the same shape, or in a new page. */
function show(about: About, send: Send): void {
  const { tick, following } = view?.playback ?? { tick: 0, following: false };
  const wasLost = isLost;
  if (wasLost) trainings.restart();
  isLost = false;
  noTrouble();
  if (view?.restart(about)) {
    if (wasLost && following) view.playback.end();
    else if (wasLost) view.playback.jump(tick);
    return;
  }
  const watched = view?.watchedIn(about); // the same run through a robot with another mind
  view?.leave();
  const fresh = (untouched ??= document.body.cloneNode(true) as HTMLElement).cloneNode(true) as HTMLElement;
  if (view) document.body.replaceWith(fresh);
  view = new View(about, send, trainings, follows);
  if (watched) view.playback.resume(watched.tick, watched.plays);
}

function closed(reason: string): void {
  isLost = true;
  trouble(reason);
}

const listener = { said: (message: Said) => said(message, send), frame: (frame: Frame) => view?.frame(frame), closed };
const send: Send = openFile(listener) ?? connect(listener);
