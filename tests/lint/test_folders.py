"""Folders where files may be named: what is in them, what is left out, and how many files that were."""

import json
import os
from pathlib import Path

import pytest

from mindlang import files
from tests.calling import RULES, Call

BODY = "".join(RULES.splitlines(True)[2:5])
REST = "".join(line for line in RULES.splitlines(True) if not line.startswith(("body", "actuator")))
COMMANDS = ("check", "lint", "fmt")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two minds that share a body, one in a folder below, and files that nobody means."""
    monkeypatch.chdir(tmp_path)
    for name, text in {
        "shared/body.mind": BODY,
        "b.mind": f'use "shared/body.mind"\n{REST}',
        "a.mind": f'use "shared/body.mind"\n{REST}',
        "deep/er/c.mind": RULES,
        "runs/old.mind": "nonsense\n",
        ".hidden/old.mind": "nonsense\n",
        "deep/build/old.mind": "nonsense\n",
        ".old.mind": "nonsense\n",
        "notes.txt": "nonsense\n",
    }.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text)
    return tmp_path


@pytest.mark.parametrize("where", [".", "", "./", "absolute"])
def test_a_folder_is_its_minds(mindc: Call, folder: Path, where: str) -> None:
    where = str(folder) if where == "absolute" else where or "../" + folder.name
    assert mindc("check", where) == (0, "", "nothing wrong in 4 files\n")
    assert mindc("fmt", where) == (0, "", "all is tidy in 4 files\n")
    assert mindc("lint", where, "--select", "unread-sensor") == (0, "", "nothing found in 4 files\n")


def test_the_order_is_that_of_paths(mindc: Call, folder: Path) -> None:
    files = [each["file"] for each in json.loads(mindc("check", ".", "--json").out)["files"]]
    assert files == ["a.mind", "b.mind", "deep/er/c.mind"]


def test_what_is_wrong_in_a_shared_file_is_told_once(mindc: Call, folder: Path) -> None:
    Path("shared/body.mind").write_text(BODY.replace("side left", "side lfet"))
    for words in (("check",), ("lint", "--select", "unread-sensor")):
        said = mindc(*words, ".")
        assert said.code == 1
        assert (said.out + said.err).count("body.mind:2:") == 1
        assert said.err.splitlines()[-1] in ("1 mistake in 4 files", "1 finding in 4 files")


def test_a_folder_that_is_named_is_looked_into_whatever_it_is_called(mindc: Call, folder: Path) -> None:
    assert mindc("check", "runs").err.endswith("1 mistake in 1 file\n")
    assert mindc("check", "a.mind", ".hidden").code == 1


def test_a_file_that_is_named_twice_is_read_once(mindc: Call, folder: Path) -> None:
    files = json.loads(mindc("check", "deep", "deep/er/c.mind", "--json").out)["files"]
    assert [each["file"] for each in files] == ["deep/er/c.mind"]


@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_without_minds_is_one_sentence(mindc: Call, folder: Path, command: str) -> None:
    Path("empty/build").mkdir(parents=True)
    Path("empty/build/a.mind").write_text(RULES)
    said = mindc(command, "empty")
    assert (said.code, said.out) == (2, "")
    assert said.err.startswith("empty has no .mind")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_with_too_much_in_it_is_refused(
    mindc: Call, folder: Path, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "MAX_FOLDER_ENTRIES", 3)
    said = mindc(command, ".")
    assert (said.code, said.out) == (2, "")
    assert ". has more than 3 files and folders below it." in said.err


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read every folder")
def test_a_folder_that_cannot_be_read_is_told(mindc: Call, folder: Path) -> None:
    Path("deep").chmod(0)
    said = mindc("check", ".")
    Path("deep").chmod(0o700)
    assert said.code == 2
    assert "The folder ./deep cannot be read" in said.err


def test_links_in_a_circle_are_not_followed(mindc: Call, folder: Path) -> None:
    Path("deep/up").symlink_to("..")
    assert mindc("check", ".").err == "nothing wrong in 4 files\n"


def test_tidying_says_what_is_left(mindc: Call, folder: Path) -> None:
    Path("a.mind").write_text(Path("a.mind").read_text().replace("master Roam", "master   Roam"))
    Path("deep/er/c.mind").write_text("what is this\n")
    assert mindc("fmt", ".", "--check").err.endswith("2 not tidy in 4 files\n")
    said = mindc("fmt", ".")
    assert said.code == 1
    assert "a.mind is tidy now\n" in said.err
    assert said.err.endswith("1 not tidy in 4 files\n")


def test_breakpoints_are_checked_and_tidied_too(mindc: Call, folder: Path) -> None:
    Path("deep/er/c.break").write_text("stop when ball_baering > 0.5\n")
    said = mindc("check", ".")
    assert said.code == 1
    assert "Did you mean ball_bearing?" in said.err
    assert "in 5 files" in said.err
