// Which `mindc` serves the editor: the setting, or one of the environment that lies in the folder.
const path = require("path");

const DEFAULT = "mindc";
const ENVIRONMENTS = [".venv", "venv"];

// In a folder that is not trusted, nothing that lies in it is run.
function program(setting, { folders, home, isTrusted, exists }) {
  const said = (setting || "").trim() || DEFAULT;
  if (said === DEFAULT) return (isTrusted && environments(folders).find(exists)) || DEFAULT;
  if (said.includes("${workspaceFolder}")) {
    return isTrusted && folders.length ? said.replaceAll("${workspaceFolder}", folders[0]) : DEFAULT;
  }
  return said === "~" || said.startsWith("~/") ? path.join(home, said.slice(1)) : said;
}

function environments(folders) {
  return folders.flatMap((folder) => ENVIRONMENTS.map((name) => path.join(folder, name, "bin", DEFAULT)));
}

module.exports = { program };
