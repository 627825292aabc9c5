"""The walker: whose turn it is to swing changes with its steps, and not by itself."""

import numpy as np
import pytest

from mindlang import load
from tests.language.examples import ROOT

WALKER = ROOT / "examples" / "walker" / "walker.mind"
STEPS = 5


def test_its_legs_take_turns_and_each_begins_where_a_foot_came_down() -> None:
    pytest.importorskip("gymnasium")
    pytest.importorskip("Box2D")
    run = load(WALKER).trace_table("Walk", seed=1)
    turn, phase, landed = (np.asarray(run[f"reading {name}"]) for name in ("turn", "phase", "landed"))
    taken = np.flatnonzero(np.diff(turn))
    assert {*turn.tolist()} == {0.0, 1.0}
    assert len(taken) >= STEPS
    assert (landed[taken] == 1).all()
    assert (phase[taken + 1] == 0).all()
