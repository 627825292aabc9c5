"""The VS Code extension: all of its parts are there, and it packages."""

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from mindlang.server import commands
from tests.language.examples import ROOT

FOLDER = ROOT / "editors" / "vscode"
PACKAGE = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
SCRIPT = (FOLDER / "extension.js").read_text(encoding="utf-8")


def test_what_it_names_is_there() -> None:
    contributes = PACKAGE["contributes"]
    named = [PACKAGE["icon"], *(each["path"] for each in contributes["grammars"])]
    named += [each["configuration"] for each in contributes["languages"]]
    shipped = re.findall(r"^!(.*)$", (FOLDER / ".vscodeignore").read_text(), re.MULTILINE)
    for path in map(Path, named):
        assert (FOLDER / path).is_file()
        assert path.as_posix() in shipped
    assert json.loads((FOLDER / "language-configuration.json").read_text())["comments"] == {"lineComment": "#"}


def test_it_is_of_this_version_and_licence() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert (PACKAGE["version"], PACKAGE["license"]) == (project["version"], project["license"])
    assert (FOLDER / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    assert json.loads((FOLDER / "package-lock.json").read_text())["version"] == PACKAGE["version"]


def test_its_commands_are_its_own_and_the_server_s() -> None:
    own = {each["command"] for each in PACKAGE["contributes"]["commands"]}
    assert set(re.findall(r'registerCommand\("([\w.]+)"', SCRIPT)) == own
    assert own.isdisjoint({commands.EDIT, commands.EDITS})  # the client makes those of the server itself
    assert {commands.EDIT, commands.EDITS} <= set(re.findall(r'"(mind\.\w+)"', SCRIPT))


def test_a_folder_that_is_not_trusted_does_not_say_what_is_run() -> None:
    trust = PACKAGE["capabilities"]["untrustedWorkspaces"]
    assert (trust["supported"], trust["restrictedConfigurations"]) == ("limited", ["mind.path"])


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node")
@pytest.mark.parametrize("script", ["extension.js", "program.js"])
def test_its_scripts_can_be_read(script: str) -> None:
    subprocess.run(["node", "--check", FOLDER / script], check=True)


OWN = "/work/robot/.venv/bin/mindc"


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node")
@pytest.mark.parametrize(
    ("setting", "there", "trusted", "run"),
    [
        ("mindc", [], True, "mindc"),
        ("mindc", [OWN], True, OWN),
        ("", [OWN.replace(".venv", "venv")], True, OWN.replace(".venv", "venv")),
        ("mindc", [OWN], False, "mindc"),  # what lies in a folder that is not trusted is never run
        ("${workspaceFolder}/.venv/bin/mindc", [OWN], True, OWN),
        ("${workspaceFolder}/.venv/bin/mindc", [OWN], False, "mindc"),
        ("~/bin/mindc", [OWN], False, "/home/me/bin/mindc"),
        ("/opt/mindc", [OWN], True, "/opt/mindc"),
        ("~other/mindc", [], True, "~other/mindc"),
    ],
)
def test_which_mindc_serves(setting: str, there: list[str], trusted: bool, run: str) -> None:
    world = f"folders: ['/work/robot', '/work/more'], home: '/home/me', isTrusted: {json.dumps(trusted)}"
    call = f"program({json.dumps(setting)}, {{{world}, exists: (path) => {json.dumps(there)}.includes(path)}})"
    script = f"console.log(require({json.dumps(str(FOLDER / 'program.js'))}).{call})"
    said = subprocess.run(["node", "-e", script], capture_output=True, text=True, check=True)
    assert said.stdout == f"{run}\n"


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("npm"), reason="there is no npm")
def test_it_packages(tmp_path: Path) -> None:
    folder = tmp_path / "vscode"
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("node_modules", "dist", "*.vsix"))
    subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=folder, check=True)
    subprocess.run(["npm", "run", "package"], cwd=folder, check=True)
    (made,) = folder.glob("*.vsix")
    assert made.stat().st_size < 200_000
