"""`mindc edit undo`: the last edit taken back with its locks and weights, or refused where files have changed."""

import json
from itertools import count
from pathlib import Path

import pytest

from mindlang.editing.transaction import UNDO_NAME, TransactionError, change, undo
from tests.calling import Call
from tests.edits.changing import ONE, OTHER, files
from tests.edits.taught import teach, write_mind
from tests.edits.test_journal import Crash, failing, found


@pytest.fixture
def drive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = write_mind(tmp_path)
    teach(path)
    return path


def project(folder: Path) -> dict[str, bytes]:
    """All files but the journal of the last edit."""
    return {name: data for name, data in found(folder).items() if name != UNDO_NAME}


@pytest.mark.parametrize(
    "words",
    [
        ("rename", "Go", "Zo"),
        ("connect", "Drive", "charge", "--keep-weights"),
        ("split", "parts.mind", "Go", "Avoid"),
        ("freeze", "Go"),
    ],
)
def test_an_edit_is_taken_back_once(mindc: Call, drive: Path, words: tuple[str, ...]) -> None:
    before = project(drive.parent)
    edit, *more = words
    assert mindc("edit", edit, drive, *more, "--write").code == 0
    after = project(drive.parent)
    assert after != before
    said = mindc("edit", "undo")
    assert said.code == 0, said.err
    assert project(drive.parent) == before
    assert f"taken back: {drive.name}" in said.err
    assert said.out.startswith("--- ")
    assert mindc("edit", "undo", drive).code == 1
    assert found(drive.parent) == before
    assert mindc("edit", edit, drive, *more, "--write").code == 0
    assert project(drive.parent) == after


@pytest.mark.parametrize("suffix", [".mind", ".lock"])
def test_what_has_changed_since_is_not_lost(mindc: Call, drive: Path, suffix: str) -> None:
    assert mindc("edit", "rename", drive, "Go", "Zo", "--write").code == 0
    with drive.with_suffix(suffix).open("a") as file:
        file.write("# later\n")
    before = found(drive.parent)
    said = mindc("edit", "undo")
    assert (said.code, said.out) == (1, "")
    assert "has been changed since the last edit was written.\n  nothing has been taken back" in said.err
    assert found(drive.parent) == before


def test_only_what_was_written_is_taken_back(mindc: Call, drive: Path) -> None:
    mindc("edit", "rename", drive, "Go", "Zo")
    said = mindc("edit", "undo")
    assert (said.code, said.out) == (1, "")
    assert "no edit has been written that could be taken back" in said.err
    assert mindc("edit", "undo", "nowhere").code == 2


def test_from_a_folder_below_and_as_json(mindc: Call, drive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mindc("edit", "rename", drive, "Go", "Zo", "--write")
    below = drive.parent / "below"
    below.mkdir()
    monkeypatch.chdir(below)
    said = mindc("edit", "undo", "--json")
    assert (said.code, said.err) == (0, "")
    data = json.loads(said.out)
    assert sorted(data["written"]) == sorted([drive.name, drive.with_suffix(".lock").name])
    assert "+skill Go" in data["diff"]


@pytest.mark.parametrize("text", ["", "[]", '{"../out.mind": {"was": null, "becomes": ""}}'])
def test_what_mindc_did_not_write_is_not_undone(mindc: Call, drive: Path, text: str) -> None:
    (drive.parent / UNDO_NAME).write_text(text)
    said = mindc("edit", "undo")
    assert said.code == 1
    assert f"{UNDO_NAME} is not what mindc wrote" in said.err


def test_a_crash_between_any_two_operations_is_undone_by_the_next(tmp_path: Path) -> None:
    """A change that made a file is undone, so that one goes."""
    (tmp_path / "weights").mkdir()
    for last in count():
        for name in OTHER.keys() - ONE.keys():
            (tmp_path / name).unlink(missing_ok=True)
        for path, data in files(tmp_path, ONE).items():
            path.write_bytes(data)
        change(tmp_path, files(tmp_path, OTHER), keeps=True)
        crashed = None
        with pytest.MonkeyPatch.context() as patch:
            failing(patch, lambda number, _, last=last: Crash() if number >= last else None)
            patch.setattr("mindlang.editing.transaction._put_back", lambda *_: None)
            try:
                undo(tmp_path)
            except Crash as crash:
                crashed = crash
        if (tmp_path / UNDO_NAME).exists():
            undo(tmp_path)
        now = {name: data for name, data in project(tmp_path).items() if not name.startswith(".")}
        assert now == ONE, f"after {last} operations"
        if crashed is None:
            break
    assert last > 5


def test_files_changed_by_something_else_are_not_taken_back(tmp_path: Path) -> None:
    (tmp_path / "weights").mkdir()
    change(tmp_path, files(tmp_path, ONE), keeps=True)
    change(tmp_path, files(tmp_path, OTHER))
    with pytest.raises(TransactionError, match="has been changed since the last edit"):
        undo(tmp_path)
    assert project(tmp_path) == OTHER
