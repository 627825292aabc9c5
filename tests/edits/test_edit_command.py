"""`mindc edit` as its users call it: verified, refused, told of the files beside, read from standard input."""

import json
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from tests.calling import Call
from tests.edits.taught import MIND, teach, write_mind


@pytest.fixture
def drive(tmp_path: Path) -> Path:
    path = write_mind(tmp_path)
    teach(path)
    return path


def test_verify_runs_what_is_untouched(mindc: Call, drive: Path) -> None:
    said = mindc("edit", "connect", "Drive", "charge", drive, "--keep-weights", "--verify", "--write")
    assert said.code == 0, said.err
    assert "verified: Drive, Avoid and Go did the same to the bit" in said.err
    said = mindc("edit", "disconnect", "Drive", "charge", drive, "--verify")
    assert "verified: Avoid and Go did the same to the bit" in said.err


def test_verify_refuses_what_does_something_else(mindc: Call, drive: Path) -> None:
    """Three skills that drive one wheel, added up in another order: the last bit may differ, and no more does."""
    third = "skill Third is mlp\n  reads charge\n  reads eye\n  drives left_wheel\n  drives right_wheel\n\n"
    text = MIND.replace("task Roam", f"{third}task Roam").replace(
        "influences Go\n", "influences Go\n  influences Third\n"
    )
    drive.write_text(text)
    for seed in range(9):
        teach(drive, seed=seed)
        said = mindc("edit", "rename", "Go", "Zo", drive, "--verify", "--write")
        if said.code:
            break
        mindc("edit", "rename", "Zo", "Go", drive, "--write")
    assert said.code == 1
    assert "Drive would do something else: at tick" in said.err
    assert "Only the rounding differs" in said.err
    assert drive.read_text() == text


def test_verify_of_nothing(mindc: Call, tmp_path: Path) -> None:
    said = mindc("edit", "freeze", "Go", write_mind(tmp_path), "--verify")
    assert said.code == 0
    assert "verified: there is no trained skill that this edit leaves as it was" in said.err


def test_standard_input_is_edited_and_not_written(mindc: Call, drive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", TextIOWrapper(BytesIO(MIND.encode())))
    said = mindc("edit", "freeze", "Go", "-")
    assert said.code == 0
    assert "+  stays frozen" in said.out
    said = mindc("edit", "freeze", "Go", "-", "--write")
    assert (said.code, said.err.splitlines()[0]) == (2, "Standard input cannot be written.")


def test_what_is_refused_as_json_is_one_document(mindc: Call, drive: Path) -> None:
    said = mindc("edit", "connect", "Drive", "claw", drive, "--keep-weights", "--json")
    found = json.loads(said.out)["diagnostics"][0]
    assert (said.code, said.err, found["code"]) == (1, "", "impossible-edit")
    assert found["message"] == "Drive cannot keep its weights: sends claw is new."
    said = mindc("edit", "connect", "Drive", "charge", drive, "--keep-weights", "--json", "--write")
    assert json.loads(said.out)["written"]
    assert (said.code, said.err) == (0, "")


@pytest.mark.parametrize(
    "words",
    [
        ["rename", "Go", "Zo"],
        ["rename", "Go", "Zo", "--noun", "skill"],
        ["remove", "sensor", "unread"],
        ["add", "sensor one is battery", "sensor two is sine period 2 s"],
        ["extract", "Drive", "Both", "Avoid", "Go"],
        ["split", "parts.mind", "Go", "Avoid"],
    ],
)
def test_the_file_may_stand_first_or_last(mindc: Call, drive: Path, words: list[str]) -> None:
    drive.write_text(MIND.replace("sensor eye", "sensor unread is battery\nsensor eye", 1))
    last, first = mindc("edit", *words, drive), mindc("edit", words[0], drive, *words[1:])
    assert last.code == 0, last.err
    assert first == last


def test_a_file_that_is_not_there_is_said_to_be_none(mindc: Call, drive: Path) -> None:
    gone = drive.with_name("gone.mind")
    for words in (["rename", gone, "Go", "Zo"], ["rename", "Go", "Zo", gone]):
        said = mindc("edit", *words)
        assert (said.code, said.out) == (2, "")
        assert "gone.mind cannot be read" in said.err


def test_what_is_written_is_said(mindc: Call, drive: Path) -> None:
    assert mindc("edit", "rename", "Go", "Zo", drive).err.splitlines()[-1].startswith("nothing has been written: ")
    said = mindc("edit", "rename", "Go", "Zo", drive, "--write")
    assert said.err.splitlines()[-1] == f"written: {drive.name} and {drive.stem}.lock"


def test_a_name_is_removed_by_itself_unless_two_have_it(mindc: Call, drive: Path) -> None:
    drive.write_text(MIND.replace("sensor eye", "sensor unread is battery\nsensor eye", 1))
    whole = mindc("edit", "remove", "sensor unread", drive)
    assert "-sensor unread is battery" in whole.out
    assert mindc("edit", "remove", "unread", drive) == whole
    assert mindc("edit", "remove", "unread", "--noun", "sensor", drive) == whole
    said = mindc("edit", "remove", "unraed", drive)
    assert (said.code, said.out) == (1, "")
    assert "Did you mean unread?" in said.err
