"""A frozen skill is not taught: not by name, not by force, not with its parents, not by a run that goes on."""

import json
from pathlib import Path

import pytest
from mindrun.graph.weights import learners
from mindrun.train.manifest import fingerprint

from mindlang.compiler.compile import load
from mindlang.lock import lock_path, read_lock
from mindlang.lock.signature import arrange
from tests.calling import Call
from tests.edits.taught import teach, write_mind
from tests.train.test_train_command import MIND

JOINT = MIND.replace(
    "curriculum Rest", "curriculum Joint is genetic population 8\n"
    "  teaches Drive on Reach for 2 generations with subskills\ncurriculum Rest"
)  # fmt: skip
QUICK = ("--seed", 1, "--generations", 1, "-q")


@pytest.fixture
def drive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = write_mind(tmp_path, JOINT)
    teach(path)
    return path


def weights(path: Path) -> dict[str, str]:
    """The hashes of the weights in the lock."""
    return {name: entry.weights for name, entry in read_lock(lock_path(path)).items()}


def freeze(mindc: Call, path: Path, skill: str, edit: str = "freeze") -> None:
    said = mindc("edit", edit, skill, path, "--write")
    assert said.code == 0, said.err


def test_a_frozen_skill_refuses_training(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Go")
    before = weights(drive)
    for how in (("Go",), ("Go", "--force"), ("--force",), ("Go", "--from-scratch")):
        said = mindc("train", drive, *how, *QUICK)
        assert said.code == 1
        assert said.err.splitlines() == ["Go is frozen", f"  mindc edit unfreeze {drive.name} Go --write"]
    assert weights(drive) == before
    assert not (drive.parent / "runs").exists()


def test_force_begins_nothing_where_a_later_lesson_would_be_refused(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Drive")
    before = weights(drive)
    said = mindc("train", drive, "--force", *QUICK)
    assert (said.code, weights(drive)) == (1, before)
    assert "Drive is frozen" in said.err


def test_nothing_to_do_says_what_is_left_out(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Go")
    said = mindc("train", drive)
    assert said.code == 0
    assert "nothing to do: all other lessons have been taught" in said.err


def test_what_an_edit_makes_stale_and_is_frozen_is_told(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Go")
    said = mindc("edit", "disconnect", "Go", "right_wheel", drive)
    assert "Go is frozen: unfreeze it to teach it again" in said.err


def test_a_frozen_skill_is_left_out_with_a_sentence(mindc: Call, drive: Path) -> None:
    lock_path(drive).unlink()
    teach(drive, "Go")
    freeze(mindc, drive, "Go")
    before = weights(drive)
    said = mindc("train", drive, "--seed", 1, "--generations", 1)
    assert said.code == 0, said.err
    assert "Go is frozen, and is not taught" in said.err.splitlines()
    assert weights(drive)["Go"] == before["Go"]
    assert set(weights(drive)) == {"Go", "Drive"}


def test_a_frozen_skill_that_has_no_weights_is_said_to_be_missing(mindc: Call, drive: Path) -> None:
    lock_path(drive).unlink()
    freeze(mindc, drive, "Go")
    said = mindc("train", drive, "Drive", *QUICK)
    assert said.code == 1
    assert "Go has not been taught (and is frozen: unfreeze it first)" in said.err


def test_lessons_with_subskills_leave_it_out(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Go")
    before = weights(drive)
    said = mindc("train", drive, "Drive", "--curriculum", "Joint", *QUICK, "--json")
    assert said.code == 0, said.err
    assert set(json.loads(said.out)["weights"]) == {"Drive"}
    after = weights(drive)
    assert after["Go"] == before["Go"]
    assert read_lock(lock_path(drive))["Drive"].taught.jointly


def test_a_run_of_what_is_frozen_now_does_not_go_on(mindc: Call, drive: Path) -> None:
    first = mindc("train", drive, "Drive", "--curriculum", "Joint", *QUICK, "--json")
    run = drive.parent / json.loads(first.out)["run"]
    (run / "result.json").unlink()  # as if it had been stopped
    learnt = weights(drive)
    freeze(mindc, drive, "Go")
    said = mindc("train", "--resume", run)
    assert said.code == 1
    assert "has changed since this run of Drive began" in said.err
    assert weights(drive) == learnt
    freeze(mindc, drive, "Go", "unfreeze")
    assert mindc("train", "--resume", run, "-q").code == 0


def test_the_same_lesson_with_fewer_learners_is_another_run(mindc: Call, drive: Path) -> None:
    """A run that was stopped before its subskill was frozen is not taken up again by the same command."""
    command = ("train", drive, "Drive", "--curriculum", "Joint", *QUICK, "--json")
    run = drive.parent / json.loads(mindc(*command).out)["run"]
    (run / "result.json").unlink()
    teach(drive)
    freeze(mindc, drive, "Go")
    again = json.loads(mindc(*command).out)
    assert drive.parent / again["run"] != run
    assert set(again["weights"]) == {"Drive"}


def test_freezing_changes_no_other_lesson(mindc: Call, drive: Path) -> None:
    def fingerprints() -> dict[str, str]:
        graph = load(drive).graph
        assert graph
        graph = arrange(graph, read_lock(lock_path(drive)))
        return {f"{lesson.curriculum} {lesson.skill}": fingerprint(graph, lesson, None) for lesson in graph.lessons}

    before = fingerprints()
    freeze(mindc, drive, "Go")
    assert fingerprints() == before
    graph = load(drive).graph
    assert graph
    assert [learners(graph, lesson) for lesson in graph.lessons] == [(), ("Drive",), ("Drive",), ()]


def test_freezing_makes_nothing_stale_and_stands_in_the_status(mindc: Call, drive: Path) -> None:
    freeze(mindc, drive, "Drive")
    said = mindc("status", drive)
    assert said.code == 0
    assert said.out.split()[:3] == ["Drive", "trained,", "frozen"]
    assert [row["frozen"] for row in json.loads(mindc("status", drive, "--json").out)["skills"]] == [True, False]


@pytest.mark.parametrize(("edit", "why"), [("freeze", "Go is frozen already."), ("unfreeze", "Go is not frozen.")])
def test_twice_is_refused(mindc: Call, drive: Path, edit: str, why: str) -> None:
    if edit == "freeze":
        freeze(mindc, drive, "Go")
    text = drive.read_bytes()
    said = mindc("edit", edit, "Go", drive, "--write")
    assert (said.code, drive.read_bytes()) == (1, text)
    assert why in said.err
