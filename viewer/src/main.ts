/** The page of mindc view: takes in what is said, and shows it. */

import { connect, type Frame, type Said, type Send } from "./protocol";
import { element } from "./elements";
import { openFile } from "./file";
import { View } from "./view";

let view: View | undefined;

function said(message: Said, send: Send): void {
  if (message.say === "about") view ??= new View(message, send);
  else view?.said(message);
}

function closed(reason: string): void {
  element("state").textContent = view ? `disconnected: ${reason}` : `cannot connect: ${reason}`;
  element("state").classList.add("alarm");
}

const listener = { said: (message: Said) => said(message, send), frame: (frame: Frame) => view?.frame(frame), closed };
const send: Send = openFile(listener) ?? connect(listener);
