"""Edits of drawn minds in drawn environments: what promises to keep the behaviour keeps every bit of a run."""

import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import pytest

pytest.importorskip("gymnasium")

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from mindlang.editing.apply import apply_edit, write
from mindlang.editing.edits import edit
from mindlang.editing.project import open_project
from mindlang.lock.status import Trained, make_ready
from tests.draws import cases
from tests.edits.taught import statuses, teach
from tests.outside import drawn_worlds
from tests.outside.drawn import environment_mind

NEW = {"skill": "Fresh", "task": "Elsewhere", "sensor": "fresh", "actuator": "fresh", "memory": "fresh"}


def written(folder: Path, number: int) -> Path:
    """A drawn mind in a file, all that learns in it taught."""
    drawn_worlds.register()
    text = environment_mind(Random(number))
    learners = [name for name, kind in re.findall(r"^skill (\w+) is (\w+)", text, re.M) if kind != "rule"]
    lessons = "".join(f"  teaches {name} on Go under Go for 3 generations\n" for name in reversed(learners))
    path = folder / "drawn.mind"
    path.write_text(f"{text}curriculum School is genetic population 8\n{lessons}")
    teach(path)
    return path


def made(path: Path, name: str, keep_weights: bool = False, **said: Any) -> None:
    """Make an edit of a file."""
    project = open_project(load(path))
    write(apply_edit(project, edit(name).function(project, **said), keep_weights))


def run_of(path: Path, seed: int) -> Iterator[tuple[bytes, ...]]:
    """Every tick of a run of a mind as its file stands: what was sent, paid, what happened, and who had influence."""
    compiled = load(path)
    assert compiled.graph, [each.message for each in compiled.diagnostics]
    ready = make_ready(compiled.graph, compiled.sources)
    assert ready.refusals == ()
    [task] = ready.policy.graph.tasks
    for moment in trace(rollout_for(ready.policy, task.name, ready.policy.graph.master), seed).moments:
        in_order = [getattr(moment, name).tobytes() for name in ("acting", "lines", "events")]
        yield *in_order, np.sort(moment.influence).tobytes()  # skills stand in the order of their names


def declared(path: Path) -> list[tuple[str, str]]:
    """The nouns and names of a file that can have others."""
    found = re.findall(r"^(skill|sensor|actuator|memory|task) (\w+)", path.read_text(), re.M)
    return [(noun, name) for noun, name in found if noun in NEW]


@settings(max_examples=cases(15) // 2, deadline=None)
@given(number=st.integers(0, 100_000), seed=st.integers(0, 2**64 - 1), choice=st.integers(0, 1000))
def test_names_and_freezing_change_no_bit(number: int, seed: int, choice: int) -> None:
    with TemporaryDirectory() as folder:
        path = written(Path(folder), number)
        before, states = list(run_of(path, seed)), statuses(path)
        names = declared(path)
        noun, name = names[choice % len(names)]
        made(path, "rename", old=name, new=NEW[noun], noun=noun)
        skills = [skill for noun, skill in declared(path) if noun == "skill"]
        learner = next(skill for skill in skills if isinstance(statuses(path)[skill], Trained))
        made(path, "freeze", skill=learner)
        assert list(run_of(path, seed)) == before
        made(path, "unfreeze", skill=learner)
        made(path, "rename", old=NEW[noun], new=name, noun=noun)
        assert list(run_of(path, seed)) == before
        assert statuses(path) == states


@settings(max_examples=cases(15) // 2, deadline=None)
@given(number=st.integers(0, 100_000), seed=st.integers(0, 2**64 - 1))
def test_what_is_read_more_changes_no_bit_where_its_weights_are_kept(number: int, seed: int) -> None:
    with TemporaryDirectory() as folder:
        path = written(Path(folder), number)
        before = list(run_of(path, seed))
        made(path, "add", lines=("sensor more is computed at 1/3",))
        made(path, "integrate", keep_weights=True, skill="Go", with_=(), reads=("more",))
        after = list(run_of(path, seed))
    assert after == before


@settings(max_examples=cases(10) // 2, deadline=None)
@given(number=st.integers(0, 100_000), seed=st.integers(0, 2**64 - 1))
def test_what_stands_in_a_file_of_its_own_is_the_same(number: int, seed: int) -> None:
    with TemporaryDirectory() as folder:
        path = written(Path(folder), number)
        before = list(run_of(path, seed))
        made(path, "split", to="parts.mind", names=("High",))
        after = list(run_of(path, seed))
    assert after == before


def test_the_minds_that_are_drawn_learn_and_act() -> None:
    """So that the runs that are compared are not all the same."""
    runs = []
    for number in range(4):
        with TemporaryDirectory() as folder:
            runs.append([tick[0] for tick in run_of(written(Path(folder), number), 3)])
    assert sum(len({*run}) > 1 for run in runs) > 1
    assert np.unique([len(run) for run in runs]).size > 1
