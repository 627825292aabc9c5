"""Lessons of minds in which skills share weights, or begin with those of others: taught as users do."""

import json
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.errors import MindError
from mindrun.train.run_folder import open_run

import mindlang
from mindlang.compiler.compile import load
from mindlang.editing.apply import apply_edit, write
from mindlang.editing.edits.weights import unshare
from mindlang.editing.project import open_project
from mindlang.lock import read_lock
from mindlang.lock.report import rows
from mindlang.lock.status import make_ready
from mindlang.run.setup import set_up
from tests.language.examples import COLLECT

MIND = """\
tick 1/60 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor ball_bearing is bearing of ball
sensor bin_bearing is bearing of bin

skill Go is mlp hidden 1
  reads ball_bearing
  drives left_wheel
  drives right_wheel

skill Home is like Go
  reads bin_bearing for ball_bearing
  drives right_wheel for left_wheel
  drives left_wheel for right_wheel

skill Own is mlp hidden 1
  reads bin_bearing
  drives right_wheel
  drives left_wheel

skill Top is mlp hidden 1
  reads ball_bearing
  reads bin_bearing
  influences Go
  influences Home
  influences Own

task Ball in plain
  contains ball is item size 3 reached moves
  contains bin is zone size 5 reached moves
  lasts 100 ticks
  rewards 10 on reach of ball
  rewards forward + progress toward ball per tick

task Bin in plain
  contains ball is item size 3 reached moves
  contains bin is zone size 5 reached moves
  lasts 100 ticks
  rewards forward + progress toward bin per tick

curriculum School is genetic population 8 attempts 1
  teaches Go on Ball for 4 generations
  teaches Own on Bin for 3 generations from Go
  teaches Top on Bin for 3 generations with subskills
"""


@pytest.fixture(scope="module")
def taught(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of a mind all of whose lessons have been taught."""
    folder = tmp_path_factory.mktemp("alike")
    (folder / "m.mind").write_text(MIND)
    (folder / "results.json").write_text(json.dumps(train(folder / "m.mind")))
    return folder / "m.mind"


def train(path: Path, *skills: str) -> list[dict]:
    return mindlang.load(path).train(*skills, seed=1, runs=path.with_name("runs"))


def results(path: Path) -> list[dict]:
    found: list[dict] = json.loads((path.parent / "results.json").read_text())
    return found


def test_each_lesson_teaches_whoever_has_weights(taught: Path) -> None:
    assert [sorted(result["weights"]) for result in results(taught)] == [["Go"], ["Own"], ["Go", "Own", "Top"]]
    lock = read_lock(taught.with_suffix(".lock"))
    assert sorted(lock) == ["Go", "Own", "Top"]
    assert [name for name, _ in lock["Top"].subskills] == ["Go", "Own"]
    assert lock["Own"].origin == ("Go", results(taught)[0]["weights"]["Go"])


def test_then_there_is_nothing_to_do(taught: Path) -> None:
    found = load(taught)
    assert found.graph is not None
    assert [row.remarks for row in rows(found.graph, [taught])] == [()] * 4
    assert train(taught) == []


def test_a_run_keeps_the_copy_that_it_began_with(taught: Path) -> None:
    """Own sends right before left: the rows of the last matrix change places."""
    first, second = (open_run(taught.parent / result["run"]) for result in results(taught)[:2])
    learnt = np.load(taught.parent / first.folder / "weights.npy")
    copy = second.weights["Own"]
    assert copy[:-8].tobytes() == learnt[:-8].tobytes()
    assert copy[-8:].tolist() == [*learnt[-4:], *learnt[-8:-4]]
    assert second.manifest.lesson.starts_from == "Go"


def test_the_same_seed_teaches_the_same(taught: Path, tmp_path: Path) -> None:
    (tmp_path / "m.mind").write_text(MIND)
    train(tmp_path / "m.mind", "Go", "Own")
    lock = read_lock(tmp_path / "m.lock")
    assert lock["Own"].weights == results(taught)[1]["weights"]["Own"]


def test_a_lesson_waits_for_the_weights_that_it_begins_with(tmp_path: Path) -> None:
    (tmp_path / "m.mind").write_text(MIND)
    with pytest.raises(MindError, match="Own cannot begin with the weights of Go: Go has not been taught") as refused:
        train(tmp_path / "m.mind", "Own")
    assert refused.value.hint.startswith("first: mindc train ")
    assert refused.value.hint.endswith("m.mind Go")


def test_unshared_it_does_the_same_to_the_bit(taught: Path) -> None:
    """And nothing that was taught with the shared weights is taught elsewhere."""
    before = ready(taught)
    compiled = load(taught)
    project = open_project(compiled)
    write(apply_edit(project, unshare(project, "Home"), keep_weights=False))
    now = load(taught)
    assert now.graph is not None
    assert [row.remarks for row in rows(now.graph, [taught])] == [()] * 4
    lock = read_lock(taught.with_suffix(".lock"))
    assert lock["Home"].weights == lock["Go"].weights
    assert lock["Home"].signature.reads == ("bin_bearing",)
    assert lock["Home"].signature.sends == lock["Go"].signature.sends[::-1]
    after = ready(taught)
    for readings in np.random.default_rng(1).random((50, before.graph.width), np.float32):
        assert before.tick(readings).tobytes() == after.tick(readings).tobytes()


def ready(path: Path) -> Engine:
    """The engine of a mind with the weights of its lock."""
    found = load(path)
    assert found.graph is not None
    return Engine(make_ready(found.graph, found.sources).policy)


def test_collect_with_one_lesson_less_collects_as_much() -> None:
    """Its own figure is 11.81 ± 0.44 objects; without a drop zone to go to it would be none."""
    found = load(COLLECT.with_name("like.mind"))
    setup = set_up("like.mind", found, "Collect", None)
    assert setup.ready.notes == ()
    rollout = setup.rollout()
    scores = rollout.score(np.zeros((1, rollout.genome_length), np.float32), range(40))
    assert scores.counts.sum() / 40 > 8
