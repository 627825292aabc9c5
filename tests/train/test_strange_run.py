"""Run folders in which somebody has put something else: one sentence each, and nothing elsewhere is touched."""

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.train import RunError, checkpoint
from mindrun.train.lesson_state import LessonState
from mindrun.train.population import Population
from mindrun.train.progress import LINES, read_progress
from mindrun.train.run_folder import MANIFEST, RESULT, RunFolder, create, open_run, read_result, unfinished
from mindrun.train.training import train

from mindlang.compiler.compile import load
from mindlang.training.subject import open_subject, refuse_changed
from tests.calling import write_rules
from tests.train.climbing import LENGTH, Sphere, lesson, manifest, unwatched


@pytest.fixture
def run(tmp_path: Path) -> RunFolder:
    """A run that was stopped after three generations."""
    run = create(tmp_path, manifest(lesson(6)), {}, {})
    train(run, Sphere(), unwatched(stop_after=3))
    return run


def test_a_link_where_the_lock_is_leads_to_nothing_that_is_written(run: RunFolder, tmp_path: Path) -> None:
    (tmp_path / "precious").write_text("mine")
    (run.folder / "lock").unlink()
    (run.folder / "lock").symlink_to(tmp_path / "precious")
    with pytest.raises(RunError, match="cannot write to"):
        train(run, Sphere(), unwatched())
    assert (tmp_path / "precious").read_text() == "mine"


@pytest.mark.parametrize("name", ["lock", LINES, checkpoint.NAME, MANIFEST])
def test_a_pipe_is_not_waited_for(run: RunFolder, name: str) -> None:
    (run.folder / name).unlink()
    os.mkfifo(run.folder / name)
    with pytest.raises(RunError, match="pipe"):
        train(open_run(run.folder), Sphere(), unwatched())


def test_who_looks_for_a_run_to_go_on_with_passes_strange_ones_by(run: RunFolder, tmp_path: Path) -> None:
    assert unfinished(tmp_path, run.manifest) is not None
    (run.folder / checkpoint.NAME).unlink()
    os.mkfifo(run.folder / checkpoint.NAME)
    (run.folder.parent / "a file").touch()
    (run.folder.parent / "a folder").mkdir()
    assert unfinished(tmp_path, run.manifest) is None


@pytest.mark.parametrize("name", ["attempt", "generation", "best", "ticks"])
@pytest.mark.parametrize("value", ["one", [], True, 10**400, {"a": 1}])
def test_a_log_ends_where_it_says_what_is_no_number(run: RunFolder, name: str, value: object) -> None:
    first, second, third = (run.folder / LINES).read_bytes().splitlines()
    strange = json.dumps(json.loads(second) | {name: value}).encode()
    (run.folder / LINES).write_bytes(b"\n".join([first, strange, third, b""]))
    assert [record["generation"] for record in read_progress(run.folder)] == [1]
    train(run, Sphere(), unwatched())
    assert (run.folder / "weights.npy").exists()


@pytest.mark.parametrize("text", ["[]", "7", "[" * 9000, "9" * 5000, '{"best": 1e999}', '{"best": NaN}', ""])
def test_a_result_that_is_none_is_no_result(run: RunFolder, text: str) -> None:
    (run.folder / RESULT).write_text(text)
    found = read_result(run.folder)
    assert found is None or json.dumps(found, allow_nan=False)


def standing_at(state: LessonState, **now: object) -> LessonState:
    """The state with another attempt at work."""
    return replace(state, now=replace(state.now, **now))


FEWER = Population(np.ones((4, LENGTH), np.float32), np.ones(4), 3)
STATES: dict[str, Callable[[LessonState], LessonState]] = {
    "of fewer": lambda state: standing_at(state, population=FEWER),
    "after its end": lambda state: standing_at(state, population=replace(state.now.population, generation=6)),
    "that began later": lambda state: standing_at(state, since=5),
}


@pytest.mark.parametrize("what", STATES)
def test_a_checkpoint_to_which_no_run_comes_is_refused(run: RunFolder, what: str) -> None:
    found = checkpoint.load(run.folder, run.manifest.identity)
    assert found
    changed = checkpoint.pack(STATES[what](found[0]), run.manifest.identity)
    (run.folder / checkpoint.NAME).write_bytes(changed)
    with pytest.raises(RunError, match="no run of this lesson comes to where it stands"):
        train(run, Sphere(), unwatched())


def test_weights_to_begin_with_that_are_no_genome_are_refused(tmp_path: Path) -> None:
    weights = {"Climb": np.ones(LENGTH + 1, np.float32)}
    run = create(tmp_path, manifest(lesson(6), weights=weights), {}, weights)
    with pytest.raises(RunError, match=r"start\.npz is damaged"):
        train(open_run(run.folder), Sphere(), unwatched())


def test_a_run_of_a_skill_that_is_no_longer_there_cannot_go_on(run: RunFolder, tmp_path: Path) -> None:
    source = write_rules(tmp_path)
    with pytest.raises(RunError, match="has changed since this run of Climb began"):
        refuse_changed(open_subject(source, load(source)), run)
