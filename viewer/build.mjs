// Builds the page into mindlang/view/page/, or into the folder that is named: the same bytes on every machine.
import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const out = process.argv[2] ?? join(here, "..", "mindlang", "view", "page");
const LIBRARIES = ["@dagrejs/dagre", "uplot"];

mkdirSync(out, { recursive: true });
await build({
  entryPoints: { view: join(here, "src", "main.ts") },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  absWorkingDir: here,
});
await build({
  entryPoints: { view: join(here, "src", "view.css") },
  outdir: out,
  bundle: true,
  minify: true,
  legalComments: "none",
  absWorkingDir: here,
});
copyFileSync(join(here, "src", "index.html"), join(out, "index.html"));
const licences = LIBRARIES.map((name) => {
  const folder = join(here, "node_modules", ...name.split("/"));
  const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  return `${name} ${version}\n\n${readFileSync(join(folder, "LICENSE"), "utf8").trim()}\n`;
});
writeFileSync(join(out, "LICENSES.txt"), licences.join("\n\n"));
