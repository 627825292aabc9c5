"""The compass: all that a new kind of sensor brings along works, and all of it stands in one file."""

from collections.abc import Callable
from math import atan2, cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import Source
from mindlang.lint.lint import lint

MIND = """
tick 1/60 s
master Turn
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor north is compass{arguments}
sensor drift is derivative of north
skill Turn is rule
  reads north
  reads drift
  drives left_wheel at 0.5 + north / 8
  drives right_wheel at 0.3 - drift / 8
task Spin in arena
  lasts 2000 ticks
  rewards 1 per tick when north > 0.5
"""

Read = Callable[[str], Compiled]


def compiled(arguments: str = "") -> Compiled:
    found = compile_source(Source("spin.mind", MIND.format(arguments=arguments)), Path("spin.mind"))
    assert found.graph, found.diagnostics
    return found


def north(angle: float) -> float:
    """What a compass reads on a robot with that heading; north is the y axis."""
    return 0.5 - atan2(cos(angle), sin(angle)) / (2 * pi)


def test_it_reads_where_north_is() -> None:
    graph = compiled().graph
    assert graph
    moments = list(trace(Rollout(Policy(graph, {}), "Spin", "Turn"), 3).moments)
    angles = np.array([0.0, *(moment.body[2] for moment in moments)])
    seen = np.array([moment.readings[0] for moment in moments])
    true = np.array([north(angle) for angle in angles[:-1]])
    assert len(moments) == 2000
    assert np.ptp(seen) > 0.9
    begins = trace(Rollout(Policy(graph, {}), "Spin", "Turn"), 3).begin[2]
    true[0] = north(begins)
    assert np.abs(seen - true).max() < 1e-6


def test_its_derivative_turns_the_short_way() -> None:
    graph = compiled().graph
    assert graph
    moments = list(trace(Rollout(Policy(graph, {}), "Spin", "Turn"), 3).moments)
    seen = np.array([moment.readings for moment in moments])
    jumps = np.abs(np.diff(seen[:, 0])) > 0.5
    assert jumps.any()
    change = np.diff(seen[:, 0])
    change -= np.round(change)
    assert seen[1:, 1] == pytest.approx(np.clip(0.5 + 30 * change, 0, 1), abs=2e-4)


def test_a_dead_zone_and_faults_are_its_as_well() -> None:
    graph = compiled(" dead_zone 0.1 lost 20% noise 2% every 3 ticks delay 2 ticks").graph
    assert graph
    moments = list(trace(Rollout(Policy(graph, {}), "Spin", "Turn"), 3).moments)
    seen = np.array([moment.readings[0] for moment in moments])
    assert 500 < np.unique(seen).size < 560
    assert (seen == 0.5).mean() > 0.2


@pytest.mark.parametrize(
    ("arguments", "code"),
    [("", ""), (" dead_zone 0.6", "constant-sensor")],
)
def test_lint_knows_what_it_can_read(arguments: str, code: str) -> None:
    found = {each.code for each in lint(compiled(arguments), ["constant-sensor"])}
    assert found == ({code} if code else set())
