"""Sensors that are not perfect: late, seldom, noisy, lost; in every lane alike, and only those that say so."""

from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from numpy.typing import NDArray

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

TICKS = 400
MIND = """\
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eyes is range_finder at 0 120 240 deg range 12{rough}
sensor ball_bearing is bearing of ball{rough}
sensor charge is battery start 0.9 drain 0.1%{rough}
sensor drift is derivative of ball_bearing

skill Go is rule
  reads eyes
  reads ball_bearing
  reads charge
  reads drift
  drives left_wheel at 0.9
  drives right_wheel at 0.6

task Roam in arena size 60
  contains rock is obstacle count 8 size 3
  contains ball is item size 2
  lasts 400 ticks
  rewards forward per tick
  counts reach of ball
"""


def graph(rough: str = "") -> Graph:
    found = compile_source(Source("rough.mind", MIND.format(rough=rough))).graph
    assert found
    return found


def readings(rough: str = "", seed: int = 4) -> NDArray[np.float32]:
    """What is read in a run [ticks, readings]; where the robot goes is the same for all."""
    moments = trace(Rollout(Policy(graph(rough), {}), "Roam", "Go"), seed).moments
    return np.array([moment.readings for moment in islice(moments, TICKS)])


EYES, BALL, CHARGE, DRIFT = slice(0, 3), 3, 4, 5


@pytest.mark.parametrize("delay", [1, 2, 7])
def test_what_is_seen_is_late(delay: int) -> None:
    true, seen = readings(), readings(f" delay {delay} ticks")
    np.testing.assert_array_equal(seen[delay:, : CHARGE + 1], true[: TICKS - delay, : CHARGE + 1])
    np.testing.assert_array_equal(seen[:delay, : CHARGE + 1], np.repeat(true[:1, : CHARGE + 1], delay, axis=0))


@pytest.mark.parametrize("every", [2, 5])
def test_what_is_seldom_measured_stays_in_between(every: int) -> None:
    true, seen = readings(), readings(f" every {every} ticks")
    last = (np.arange(TICKS) // every) * every
    np.testing.assert_array_equal(seen[:, : CHARGE + 1], true[last, : CHARGE + 1])


def test_noise_is_even_and_no_more_than_said() -> None:
    true, seen = readings(), readings(" noise 5%")
    off = (seen - true)[:, : CHARGE + 1]
    off[:, BALL] = (off[:, BALL] + 0.5) % 1 - 0.5  # a direction goes round
    assert np.abs(off).max() <= 0.05 + 1e-6
    middle = (true[:, : CHARGE + 1] > 0.05) & (true[:, : CHARGE + 1] < 0.95)
    middle[:, BALL] = True
    assert abs(off[middle].mean()) < 0.003
    assert off[middle].std() == pytest.approx(0.05 / 3**0.5, rel=0.1)
    assert (seen >= 0).all()
    assert (seen <= 1).all()
    again, other = readings(" noise 5%"), readings(" noise 5%", seed=5)
    np.testing.assert_array_equal(seen, again)
    assert (other != seen).any()


def test_what_is_lost_reads_as_if_nothing_were_there() -> None:
    true, seen = readings(), readings(" lost 20%")
    lost = seen != true
    near = true[:, EYES] < 1
    assert near.sum() > 100
    assert lost[:, EYES][near].mean() == pytest.approx(0.2, abs=0.06)
    assert (seen[:, EYES][lost[:, EYES]] == 1).all()
    assert (seen[lost[:, BALL], BALL] == 0.5).all()
    assert (np.diff(seen[:, CHARGE]) <= 0).all(), "a battery reads as before"
    assert lost[:, CHARGE].mean() == pytest.approx(0.2, abs=0.06)


def test_a_derivative_is_one_of_what_is_seen() -> None:
    seen = readings(" noise 3% every 2 ticks delay 3 ticks")
    change = (seen[1:, BALL] - seen[:-1, BALL] + 0.5) % 1 - 0.5  # the short way round
    np.testing.assert_allclose(seen[1:, DRIFT], np.clip(0.5 + change * 30, 0, 1), atol=1e-4)


def test_every_lane_has_its_own_chances() -> None:
    rewarded = MIND.replace("rewards forward", "rewards charge")
    found = compile_source(
        Source("rough.mind", rewarded.format(rough=" noise 5% lost 10% every 3 ticks delay 2 ticks"))
    )
    assert found.graph
    hold_in_any_lane(found.graph)


def test_a_run_depends_on_nothing_that_ran_before_it_in_its_lane() -> None:
    """Loose obstacles were placed clear of where the things of the run before had been."""
    hold_in_any_lane(graph())


def hold_in_any_lane(of: Graph) -> None:
    """The same scores alone, one after the other, and in any company."""
    seeds, nobody = list(range(120)), np.zeros((1, 0), np.float32)
    alone = [float(Rollout(Policy(of, {}), "Roam", "Go", lanes=1).score(nobody, [seed]).total[0, 0]) for seed in seeds]
    for lanes, workers in ((1, 1), (16, 2), (64, 1)):
        found = Rollout(Policy(of, {}), "Roam", "Go", lanes=lanes, workers=workers).score(nobody, seeds)
        np.testing.assert_array_equal(found.total[0], alone)


def test_the_arguments_of_a_kind_come_before_those_of_all() -> None:
    from mindrun.kinds.registry import arguments
    from mindrun.kinds.sensors.rays import RangeFinder

    keys = [argument.key for argument in arguments(RangeFinder)]
    assert keys == ["at", "range", "dead_zone", "on", "noise", "lost", "every", "delay"]


def test_nothing_else_has_changed(tmp_path: Path) -> None:
    np.testing.assert_array_equal(readings(), readings(" noise 0% lost 0% every 1 ticks delay 0 ticks"))
