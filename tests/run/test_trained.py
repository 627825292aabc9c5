"""`mindc run` with weights of a lock: what is refused, and who is in charge."""

import json
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.weights import genes

from mindlang.compiler.compile import load
from mindlang.lock import Taught, lock_path
from mindlang.lock.blobs import record
from mindlang.lock.signature import arrange
from tests.calling import RULES, Call
from tests.edits.taught import world_in

LEARNT = (
    RULES.replace("skill Chase is rule", "skill Chase is mlp hidden 1")
    .replace(" at 3 * ball_bearing - 0.7", "")
    .replace(" at 2.3 - 3 * ball_bearing", "")
    .replace("skill Roam is rule", "skill Roam is mlp hidden 1")
    .replace("influences Chase at 1", "influences Chase")
    + """
curriculum School is genetic population 10
  teaches Chase on Chase for 5 generations
  teaches Roam on Roam for 5 generations
"""
)


@pytest.fixture
def learnt(tmp_path: Path) -> Path:
    path = tmp_path / "learnt.mind"
    path.write_text(LEARNT, encoding="utf-8")
    return path


def teach(path: Path, *skills: str) -> None:
    """Random weights into the lock, as if they had been learnt."""
    compiled, rng = load(path).graph, np.random.default_rng(1)
    assert compiled
    graph = arrange(compiled, {})
    for skill in graph.skills:
        if skill.name in skills:
            weights = rng.standard_normal(genes(skill)).astype(np.float32)
            taught = Taught("Chase", "Chase", False, 5, 10, 1, 1.0)
            record(lock_path(path), graph, {skill.name: weights}, taught, {}, world_in(graph, taught))


def test_what_has_not_been_taught_is_refused(mindc: Call, learnt: Path) -> None:
    said = mindc("run", learnt, "--task", "Roam")
    assert (said.code, said.out) == (1, "")
    assert said.err.splitlines() == [
        "Roam has not been taught",
        "Chase has not been taught",
        f"  mindc train {learnt} Chase Roam",
    ]


def test_only_what_the_master_reaches_is_needed(mindc: Call, learnt: Path) -> None:
    teach(learnt, "Chase")
    assert mindc("run", learnt, "--task", "Roam").code == 1
    found = json.loads(mindc("run", learnt, "--task", "Chase", "--json").out)
    assert found["master"] == "Chase"


def test_the_master_and_the_task_are_those_of_the_lessons(mindc: Call, learnt: Path) -> None:
    teach(learnt, "Chase", "Roam")
    found = json.loads(mindc("run", learnt, "--json").out)
    assert (found["task"], found["master"]) == ("Roam", "Roam")
    assert json.loads(mindc("bench", learnt, "--task", "Chase", "--runs", 2, "--json").out)["master"] == "Chase"


def test_stale_weights_are_refused_with_the_difference(mindc: Call, learnt: Path) -> None:
    teach(learnt, "Chase", "Roam")
    learnt.write_text(LEARNT.replace("mlp hidden 1\n  reads ball_bearing", "mlp hidden 1\n  reads feeler"))
    said = mindc("bench", learnt, "--task", "Chase", "--runs", 2)
    assert said.code == 1
    message, hint = said.err.splitlines()
    assert message.startswith("the weights of Chase are stale: ")
    assert "ball_bearing" in message
    assert hint == f"  mindc train {learnt} Chase"


def test_a_damaged_lock_is_unreadable_input(mindc: Call, learnt: Path) -> None:
    lock_path(learnt).write_text("damaged")
    said = mindc("run", learnt)
    assert said.code == 2
    assert len(said.err.splitlines()) == 1
