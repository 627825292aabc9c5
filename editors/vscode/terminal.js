// A command of mindc in a terminal: what a word above a line, or a command of the palette, stands for.

const COMMANDS = { "mind.train": "train", "mind.run": "run", "mind.bench": "bench", "mind.view": "view" };

// What is run: a program with its arguments, so that no shell reads a name, in the folder of the mind.
function invocation(command, { folder, words }) {
  return { name: `mindc ${words.join(" ")}`, command, args: [...words], options: folder ? { cwd: folder } : {} };
}

// The words above the lines of a file that a command of the palette is about, each once.
function choices(lenses, command) {
  const found = lenses.map((lens) => lens.command?.arguments?.[0]).filter((what) => what?.words[0] === COMMANDS[command]);
  return [...new Map(found.map((what) => [what.words.join(" "), what])).entries()].map(([label, what]) => ({ label, what }));
}

module.exports = { COMMANDS, choices, invocation };
