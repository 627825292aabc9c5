"""The VS Code extension: all of its parts are there, and it packages."""

import json
import re
import shutil
import subprocess
import tomllib
import zipfile
from pathlib import Path

import pytest

from mindlang.server import serve
from mindlang.server.questions import TERMINAL
from tests.language.examples import ROOT

FOLDER = ROOT / "editors" / "vscode"
PACKAGE = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
SCRIPT = (FOLDER / "extension.js").read_text(encoding="utf-8")


def test_what_it_names_is_there() -> None:
    contributes = PACKAGE["contributes"]
    named = [PACKAGE["icon"], *(each["path"] for each in contributes["grammars"])]
    named += [each["configuration"] for each in contributes["languages"]]
    (schema,) = contributes["yamlValidation"]
    assert schema["fileMatch"][0] == "robot.yaml"
    shipped = re.findall(r"^!(.*)$", (FOLDER / ".vscodeignore").read_text(), re.MULTILINE)
    for path in map(Path, named):
        assert (FOLDER / path).is_file()
        assert path.as_posix() in shipped
    assert schema["url"].removeprefix("./") in shipped  # made from docs/ when it is built
    assert json.loads((FOLDER / "language-configuration.json").read_text())["comments"] == {"lineComment": "#"}


def test_it_is_of_this_version_and_licence() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert (PACKAGE["version"], PACKAGE["license"]) == (project["version"], project["license"])
    assert (FOLDER / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    assert json.loads((FOLDER / "package-lock.json").read_text())["version"] == PACKAGE["version"]


def test_its_commands_are_its_own_and_the_server_s() -> None:
    own = {each["command"] for each in PACKAGE["contributes"]["commands"]}
    assert set(re.findall(r'registerCommand\("([\w.]+)"', SCRIPT)) == own | {TERMINAL}
    assert own.isdisjoint({serve.EDIT, serve.EDITS})  # the client makes those of the server itself
    assert {serve.EDIT, serve.EDITS} <= set(re.findall(r'"(mind\.\w+)"', SCRIPT))


def test_a_folder_that_is_not_trusted_does_not_say_what_is_run() -> None:
    trust = PACKAGE["capabilities"]["untrustedWorkspaces"]
    assert (trust["supported"], trust["restrictedConfigurations"]) == ("limited", ["mind.path"])


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node")
def test_its_scripts_can_be_read() -> None:
    for script in FOLDER.glob("*.js"):
        subprocess.run(["node", "--check", script], check=True)


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node")
def test_its_own_tests() -> None:
    done = subprocess.run(["node", "--test", "tests/"], cwd=FOLDER, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "# pass 0" not in done.stdout


def packaged(place: Path) -> Path:
    """The extension as it is installed, built in a folder that is not there yet."""
    folder = place / "editors" / "vscode"  # as deep as it is here: the schema comes from docs/
    (place / "docs").mkdir(parents=True)
    shutil.copy(ROOT / "docs" / "robot.schema.json", place / "docs")
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("node_modules", "dist", "*.vsix"))
    subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=folder, check=True)
    subprocess.run(["npm", "run", "package"], cwd=folder, check=True)
    (made,) = folder.glob("*.vsix")
    return made


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("npm"), reason="there is no npm")
def test_it_packages(tmp_path: Path) -> None:
    made = packaged(tmp_path / "built")
    assert made.stat().st_size < 200_000
    with zipfile.ZipFile(made) as archive:
        assert archive.read("extension/dist/robot.schema.json") == (ROOT / "docs" / "robot.schema.json").read_bytes()
