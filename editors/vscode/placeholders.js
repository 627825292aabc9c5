// What a setting may have in it: ~, ${workspaceFolder}, ${workspaceFolder:name}, ${userHome}, ${env:NAME}.
const path = require("path");

// The text with everything filled in, and what could not be: `folders` are the names and paths of the open ones.
function filledIn(text, { folders, home, env }) {
  const missing = [];
  const known = (found, value) => value ?? (missing.push(found), found);
  const filled = text.replaceAll(/\$\{(\w+)(?::([^}]*))?\}/g, (found, word, name) => {
    if (word === "workspaceFolder") {
      return known(found, (name ? folders.find((folder) => folder.name === name) : folders[0])?.path);
    }
    if (word === "userHome") return home;
    return known(found, word === "env" ? env[name] : undefined);
  });
  return { text: filled === "~" || filled.startsWith("~/") ? path.join(home, filled.slice(1)) : filled, missing };
}

// Whether a text depends on which folder is open.
const isOfFolder = (text) => text.includes("${workspaceFolder");

module.exports = { filledIn, isOfFolder };
