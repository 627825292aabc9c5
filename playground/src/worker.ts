/** Python and the compiler's front end, beside the page: looking at a text takes a moment, and typing never waits. */

import type { PyodideAPI } from "pyodide";
import type { Answer, FromWorker } from "./protocol";

declare const TOTAL_BYTES: number; // of all that is loaded, as it was built

const say = (message: FromWorker) => postMessage(message);
let loaded = 0;
const plainFetch = self.fetch.bind(self);
self.fetch = async (...of: Parameters<typeof fetch>) => counted(await plainFetch(...of));

/** A response whose bytes are counted as they come. */
function counted(response: Response): Response {
  if (!response.body) return response;
  const count = new TransformStream<Uint8Array, Uint8Array>({
    transform(chunk, out) {
      loaded += chunk.length;
      say({ kind: "loaded", share: Math.min(loaded / TOTAL_BYTES, 1) });
      out.enqueue(chunk);
    },
  });
  return new Response(response.body.pipeThrough(count), { status: response.status, headers: response.headers });
}

async function load(): Promise<(text: string) => string> {
  const here = new URL(".", self.location.href).href;
  const { loadPyodide } = (await import(`${here}pyodide/pyodide.mjs`)) as { loadPyodide: (of: object) => Promise<PyodideAPI> };
  const [python, frontEnd] = await Promise.all([loadPyodide({ indexURL: `${here}pyodide/` }), fetch(`${here}front_end.zip`)]);
  if (!frontEnd.ok) throw new Error(`front_end.zip: ${frontEnd.status}`);
  python.FS.mkdir("/mind");
  python.unpackArchive(await frontEnd.arrayBuffer(), "zip", { extractDir: "/lib/front_end" });
  python.runPython("import sys; sys.path.insert(0, '/lib/front_end')");
  return python.runPython("from looking import look; look") as (text: string) => string;
}

const look = load();
look.then(
  () => say({ kind: "ready" }),
  (error: unknown) => say({ kind: "failed", message: String(error) }),
);

self.onmessage = async ({ data: text }: MessageEvent<string>) => {
  try {
    say({ kind: "answer", text, answer: JSON.parse((await look)(text)) as Answer });
  } catch (error) {
    say({ kind: "failed", message: String(error) });
  }
};
