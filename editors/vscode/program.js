// Which `mindc` serves the editor: the setting, one of the environment that lies in the folder, the one beside the
// Python of the Python extension, or one in PATH.
const path = require("path");
const { filledIn, isOfFolder } = require("./placeholders");

const DEFAULT = "mindc";
const ENVIRONMENTS = [".venv", "venv"];

// `command` is what to run, undefined where there is none, and `looked` where it was looked for. In a folder that is
// not trusted, nothing that lies in it is run, and no Python that it may have chosen.
function program(setting, world) {
  const said = (setting || "").trim() || DEFAULT;
  const places = said === DEFAULT ? [...ownPlaces(world), ...inPath(DEFAULT, world)] : saidPlaces(said, world);
  return { command: places.find(({ file }) => file && world.exists(file))?.file, looked: summary(places) };
}

function ownPlaces({ folders, isTrusted, python }) {
  if (!isTrusted) return [{ label: "the folder's own environment, which you do not trust" }];
  const own = folders.flatMap((folder) => ENVIRONMENTS.map((name) => path.join(folder.path, name, "bin", DEFAULT)));
  const beside = python ? [path.join(path.dirname(python), DEFAULT)] : [];
  return [...new Set([...own, ...beside])].map((file) => ({ file, label: file }));
}

function saidPlaces(said, world) {
  if (isOfFolder(said) && !world.isTrusted) {
    return [{ label: `mind.path (${said}), in a folder that you do not trust` }, ...inPath(DEFAULT, world)];
  }
  const { text, missing } = filledIn(said, world);
  if (missing.length) return [{ label: `mind.path (${said}), where ${missing.join(", ")} is nothing` }];
  if (!text.includes("/")) return inPath(text, world);
  return [{ file: text, label: `mind.path (${text})` }];
}

function inPath(name, { env }) {
  const folders = (env.PATH || "").split(path.delimiter).filter(path.isAbsolute);
  const files = folders.map((folder) => ({ file: path.join(folder, name) }));
  return [...files, { label: name === DEFAULT ? "PATH" : `${name} in PATH` }];
}

function summary(places) {
  return places.map(({ label }) => label).filter(Boolean);
}

// What a user is told where there is none.
function notFound(looked) {
  return `mindc was not found. Looked for: ${looked.join("; ")}. Install it (pip install 'mindlang[lsp]'), or say where it is: mind.path`;
}

module.exports = { program, notFound };
