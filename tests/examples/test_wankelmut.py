"""Wankelmut: solved by when it changes its mind, on top of skills that stay as they are."""

from pathlib import Path

import numpy as np
from mindrun.sim.rollout import Rollout

from mindlang import TrainOptions, load
from mindlang.run.setup import NO_GENOME, layouts
from tests.language.examples import ROOT

WANKELMUT = ROOT / "examples" / "wankelmut" / "wankelmut.mind"
ALONE = "Up", "Down"


def scores(rollout: Rollout, runs: int = 20) -> np.ndarray:
    """The score of each run on fresh layouts."""
    found: np.ndarray = rollout.score(NO_GENOME, layouts(1, runs)).total[0]
    return found


def test_it_is_solved_and_changes_its_mind_where_it_was_bright_or_dark() -> None:
    mind = load(WANKELMUT)
    assert (scores(mind.rollout("Wankelmut", "Waver")) >= 95).all()
    run = mind.trace_table("Wankelmut", seed=1)
    mood, glow = (np.asarray(run[f"reading {name}"]) for name in ("mood", "glow"))
    changes = np.flatnonzero(np.diff(mood > 0.5))
    assert len(changes) >= 8
    assert ((glow[changes] > 0.85) | (glow[changes] < 0.15)).all()


def test_what_was_taught_alone_stays_to_the_bit(tmp_path: Path) -> None:
    path = tmp_path / "wankelmut.mind"
    path.write_text(WANKELMUT.read_text(encoding="utf-8").replace(" needs score > 96", ""), encoding="utf-8")
    load(path).train(*ALONE, seed=2, runs=tmp_path)
    before = alone(path)
    load(path).train("Waver", options=TrainOptions(scale=0.05), seed=2, runs=tmp_path)
    assert scores(load(path).rollout("Wankelmut", "Waver")).mean() > 0  # it is taught
    assert alone(path) == before


def alone(path: Path) -> list[bytes]:
    """The weights of each skill that was taught alone, and what it scores in its own task."""
    mind = load(path)
    weights = [mind.policy(skill).weights[skill].tobytes() for skill in ALONE]
    return weights + [scores(mind.rollout(skill, skill)).tobytes() for skill in ALONE]
