/** The server of this page, which knows us by the token behind # in the address; it is called again while it does not answer. */

import { frameOf, type Listener, type Said, type Send } from "./protocol";

const AGAIN_MILLISECONDS = 2000;
const NO_TOKEN = 1008;
const TOO_MANY = 1013;

/** What an end of a connection means to who sees the page. */
function reason(code: number): string {
  if (code === NO_TOKEN) return "this address is of a view that has ended: open the one that mindc view has printed last";
  if (code === TOO_MANY) return "as many as can see this run do so already: this page waits for one to leave";
  return "mindc view does not answer: this page calls it again, and shows what it has";
}

export function connect(listener: Listener): Send {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  let socket: WebSocket;
  const open = () => {
    socket = new WebSocket(`${scheme}//${location.host}/rows`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(location.hash.slice(1));
    socket.onclose = ({ code }) => {
      listener.closed(reason(code));
      if (code !== NO_TOKEN) setTimeout(open, AGAIN_MILLISECONDS);
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") listener.said(JSON.parse(data) as Said);
      else listener.frame(frameOf(data as ArrayBuffer));
    };
  };
  open();
  return (message) => socket.readyState === WebSocket.OPEN && socket.send(JSON.stringify(message));
}
