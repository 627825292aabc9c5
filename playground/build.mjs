// Builds the playground into build/site/playground, or into the folder that is named: everything that it loads lies there.
import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const packed = join(here, "..", "build", "playground"); // by pack.py
const out = process.argv[2] ?? join(here, "..", "build", "site", "playground");
const PYTHON = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json"];
const FETCHED = ["pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json"]; // and not imported
const LIBRARIES = ["@codemirror/commands", "@codemirror/language", "@codemirror/state", "@codemirror/view", "@dagrejs/dagre", "@lezer/highlight"];

mkdirSync(join(out, "pyodide"), { recursive: true });
const python = (name) => join(here, "node_modules", "pyodide", name);
for (const name of PYTHON) copyFileSync(python(name), join(out, "pyodide", name));
copyFileSync(join(packed, "front_end.zip"), join(out, "front_end.zip"));
copyFileSync(join(here, "src", "index.html"), join(out, "index.html"));

const sizes = [...FETCHED.map(python), join(packed, "front_end.zip")].map((path) => statSync(path).size);
const options = { outdir: out, bundle: true, minify: true, target: "es2022", charset: "ascii", legalComments: "none", absWorkingDir: here };
await build({
  ...options,
  entryPoints: { playground: join(here, "src", "main.ts"), worker: join(here, "src", "worker.ts") },
  format: "esm",
  define: { TOTAL_BYTES: String(sizes.reduce((sum, size) => sum + size, 0)) },
});
await build({ ...options, entryPoints: { playground: join(here, "src", "playground.css") } });

const licences = LIBRARIES.map((name) => {
  const folder = join(here, "node_modules", ...name.split("/"));
  const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  return `${name} ${version}\n\n${readFileSync(join(folder, "LICENSE"), "utf8").trim()}\n`;
});
const { version, license } = JSON.parse(readFileSync(python("package.json"), "utf8"));
writeFileSync(join(out, "LICENSES.txt"), [...licences, `pyodide ${version}\n\n${license}, https://pyodide.org\n`].join("\n\n"));
