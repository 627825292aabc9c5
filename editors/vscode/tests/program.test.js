// Which mindc serves the editor, and what is said where there is none.
const test = require("node:test");
const assert = require("node:assert");
const { notFound, program } = require("../program");

const OWN = "/work/robot/.venv/bin/mindc";
const WORLD = {
  folders: [{ name: "robot", path: "/work/robot" }, { name: "more", path: "/work/more" }],
  home: "/home/me",
  env: { PATH: "/usr/local/bin::relative:/usr/bin", MIND: "/opt/mind" },
  isTrusted: true,
};

// The program for a setting, where these files are there.
const found = (setting, there, world = {}) => program(setting, { ...WORLD, exists: (file) => there.includes(file), ...world }).command;

test("left as it is, the folder's own comes first, then Python's, then PATH", () => {
  const python = "/envs/robot/bin/python";
  const all = [OWN, "/work/more/venv/bin/mindc", "/envs/robot/bin/mindc", "/usr/bin/mindc"];
  for (let left = all; left.length; left = left.slice(1)) assert.equal(found("mindc", left, { python }), left[0]);
  assert.equal(found("", [OWN]), OWN);
  assert.equal(found(undefined, ["/usr/local/bin/mindc", "/usr/bin/mindc"]), "/usr/local/bin/mindc");
  assert.equal(found("mindc", ["/envs/robot/bin/mindc"]), undefined);
  assert.equal(found("mindc", ["relative/mindc"]), undefined);
});

test("what lies in a folder that is not trusted is never run", () => {
  const world = { isTrusted: false, python: "/work/robot/env/bin/python" };
  assert.equal(found("mindc", [OWN, "/work/robot/env/bin/mindc", "/usr/bin/mindc"], world), "/usr/bin/mindc");
  assert.equal(found("${workspaceFolder}/.venv/bin/mindc", [OWN, "/usr/bin/mindc"], world), "/usr/bin/mindc");
  assert.equal(found("mindc", [OWN], world), undefined);
});

for (const [setting, file] of [
  ["${workspaceFolder}/.venv/bin/mindc", OWN],
  ["${workspaceFolder:more}/bin/mindc", "/work/more/bin/mindc"],
  ["~/bin/mindc", "/home/me/bin/mindc"],
  ["${userHome}/bin/mindc", "/home/me/bin/mindc"],
  ["${env:MIND}/bin/mindc", "/opt/mind/bin/mindc"],
  ["/opt/mindc", "/opt/mindc"],
  ["  /opt/mindc  ", "/opt/mindc"],
  ["mindc-2", "/usr/bin/mindc-2"],
]) {
  test(`mind.path ${setting}`, () => {
    assert.equal(found(setting, [file]), file);
    assert.equal(found(setting, ["/usr/bin/mindc"]), undefined, "what was said is not replaced by another");
  });
}

for (const setting of ["${env:NOTHING}/mindc", "${workspaceFolder:nobody}/mindc", "${file}/mindc"]) {
  test(`${setting} is nothing`, () => {
    const { command, looked } = program(setting, { ...WORLD, exists: () => true });
    assert.equal(command, undefined);
    assert.match(looked[0], /is nothing$/);
  });
}

test("one sentence says where it was looked for, and what to do", () => {
  const { looked } = program("mindc", { ...WORLD, python: "/envs/robot/bin/python3", exists: () => false });
  assert.deepEqual(looked, [
    OWN,
    "/work/robot/venv/bin/mindc",
    "/work/more/.venv/bin/mindc",
    "/work/more/venv/bin/mindc",
    "/envs/robot/bin/mindc",
    "PATH",
  ]);
  assert.match(notFound(looked), /^mindc was not found\. Looked for: .*; PATH\. Install it \(pip install 'mindlang\[lsp\]'\)/);
});

test("with no folder open there is PATH", () => {
  assert.deepEqual(program("mindc", { ...WORLD, folders: [], exists: () => false }).looked, ["PATH"]);
  assert.equal(found("${workspaceFolder}/mindc", ["/mindc"], { folders: [] }), undefined);
});
