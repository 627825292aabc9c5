"""Directions go round: a robot in a world that is turned reads what it read, turned, whatever a sensor makes of it."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph, Start
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from numpy.typing import NDArray

from tests.draws import cases
from tests.sim.minds import compile_text

MIND = """
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor north is compass {rough}
sensor gem_bearing is bearing of gem {rough}
sensor calm_north is average of north over {over} ticks
sensor calm_gem is average of gem_bearing over {over} ticks
sensor calmer is average of calm_north over 3 ticks
sensor same is reading 1 of calmer
sensor north_drift is derivative of north range 9
sensor gem_drift is derivative of gem_bearing range 9
sensor calm_drift is derivative of same range 9
skill Go is rule
  reads north
  reads gem_bearing
  reads calm_north
  reads calm_gem
  reads calmer
  reads same
  reads north_drift
  reads gem_drift
  reads calm_drift
  drives left_wheel at {left}
  drives right_wheel at {right}
task T in plain
  contains gem is zone size 2 at {x} {y}
  starts at 0 0
  lasts 60 ticks
"""
DIRECTIONS, DRIFTS = slice(0, 6), slice(6, 9)
ROUGH = st.builds(
    "noise {} every {} ticks delay {} ticks".format,
    st.sampled_from([0.0, 0.03, 0.2, 1.0]), st.integers(1, 3), st.integers(0, 3),
)  # fmt: skip
NEAR_THE_SEAM = st.floats(-0.02, 0.02) | st.floats(-0.5, 0.5)


def graph(rough: str = "", over: int = 1, wheels: tuple[float, float] = (0.5, 0.5), behind: float = 0.0) -> Graph:
    """A robot that turns on the spot by its wheels; the gem is so many turns from behind a robot that faces east."""
    x, y = -9 * np.cos(2 * pi * behind), -9 * np.sin(2 * pi * behind)
    return compile_text(MIND.format(rough=rough, over=over, left=wheels[0], right=wheels[1], x=f"{x:f}", y=f"{y:f}"))


def facing(of: Graph, turns: float) -> Graph:
    """The same, whose robot starts turned by so many turns from south, where north is behind it."""
    task = replace(of.tasks[0], start=Start((0.0, 0.0), (turns - 0.25) * 2 * pi))
    return replace(of, tasks=(task,))


def readings(of: Graph, seed: int = 1) -> NDArray[np.float64]:
    """What is read in a run [ticks, readings]."""
    moments = trace(Rollout(Policy(of, {}), "T", "Go"), seed).moments
    return np.array([moment.readings for moment in moments], np.float64)


def apart(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far directions are from one another."""
    between = (one - other) % 1
    return np.minimum(between, 1 - between)


@settings(max_examples=cases(60), deadline=None)
@given(ROUGH, st.integers(1, 6), NEAR_THE_SEAM, NEAR_THE_SEAM, NEAR_THE_SEAM, st.floats(-0.3, 0.3), st.integers(0, 99))
@example("noise 0.03", 5, 0.0, 0.25, 0.0, 0.0, 1)
def test_turned_and_read_is_read_and_turned(
    rough: str, over: int, one: float, other: float, behind: float, spin: float, seed: int
) -> None:
    of = graph(rough, over, (0.5 - spin, 0.5 + spin), behind)
    first, then = readings(facing(of, one), seed), readings(facing(of, other), seed)
    assert ((first >= 0) & (first <= 1)).all()
    if not undecided(first, over):
        assert apart(first[:, DIRECTIONS] + other - one, then[:, DIRECTIONS]).max() < 2e-5
        assert np.abs(first[:, DRIFTS] - then[:, DRIFTS]).max() < 2e-4


def undecided(read: NDArray[np.float64], over: int) -> bool:
    """Whether two directions that are averaged, or follow one another, are opposite: then rounding decides."""
    found = 0.0
    for row in range(len(read)):
        last = read[max(0, row - max(over, 3)) : row + 1, DIRECTIONS]
        found = max(found, apart(last, read[row, DIRECTIONS]).max())
    return found > 0.4999


@pytest.mark.parametrize("noise", ["noise 5%", "noise 5% delay 2 ticks"])
def test_noise_behind_is_on_both_sides(noise: str) -> None:
    """Half of the readings just above 0, half just below 1; of five in a row the mean is nearer to the seam."""
    of = facing(graph(noise, 5, behind=-0.25), 0.0)
    read = np.concatenate([readings(of, seed) for seed in range(20)])
    for column in (0, 1):
        off = (read[:, column] + 0.5) % 1 - 0.5
        assert np.abs(off).max() <= 0.05 + 1e-6
        assert (off > 0).mean() == pytest.approx(0.5, abs=0.05)
        assert off.std() == pytest.approx(0.05 / 3**0.5, rel=0.1)
        calm = (read[:, column + 2] + 0.5) % 1 - 0.5
        assert calm.std() == pytest.approx(off.std() / 5**0.5, rel=0.3)
        assert not np.isin(read[:, column], [0.0, 1.0]).any()
