// Commands in a terminal: which there are in a file, and with what they are run.
const test = require("node:test");
const assert = require("node:assert");
const { COMMANDS, choices, invocation } = require("../terminal");
const contributed = require("../package.json").contributes.commands.map(({ command }) => command);

const lens = (...words) => ({ command: { command: "mind.terminal", arguments: [{ folder: "/work/robot", words }] } });

test("no shell reads a word", () => {
  const words = ["run", "a b.mind", "--task", "Go; rm -rf ~"];
  assert.deepEqual(invocation("/opt/mindc", { folder: "/work/robot", words }), {
    name: "mindc run a b.mind --task Go; rm -rf ~",
    command: "/opt/mindc",
    args: words,
    options: { cwd: "/work/robot" },
  });
  assert.deepEqual(invocation("mindc", { words: ["bench"] }).options, {});
});

test("a command of the palette offers its own words, each once", () => {
  const lenses = [lens("train", "a.mind"), lens("run", "a.mind"), lens("train", "a.mind", "Go"), lens("train", "a.mind", "Go"), {}];
  assert.deepEqual(choices(lenses, "mind.train").map(({ label }) => label), ["train a.mind", "train a.mind Go"]);
  assert.deepEqual(choices(lenses, "mind.run")[0].what, { folder: "/work/robot", words: ["run", "a.mind"] });
  assert.deepEqual(choices(lenses, "mind.view"), []);
});

test("each is a command of the extension", () => {
  for (const command of Object.keys(COMMANDS)) assert.ok(contributed.includes(command), command);
});
