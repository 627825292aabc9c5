/** A text in the fragment of an address, which no server sees: deflated, then base64 with letters that addresses take. */

const NAME = "#text=";
const MAX_CHARACTERS = 1 << 20;

export async function fragmentOf(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const letters = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  return NAME + letters.replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** The text in a fragment; null where there is none, or none that can be read. */
export async function textIn(fragment: string): Promise<string | null> {
  if (!fragment.startsWith(NAME)) return null;
  try {
    const letters = atob(fragment.slice(NAME.length).replace(/-/g, "+").replace(/_/g, "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = new TextDecoder("utf-8", { fatal: true }).decode(await through(bytes, new DecompressionStream("deflate-raw")));
    return text.length <= MAX_CHARACTERS ? text : null;
  } catch {
    return null;
  }
}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
