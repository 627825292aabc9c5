"""What differs from run to run: drawn of the seed alone, as if it had been said, and nothing else in the world does."""

from dataclasses import replace

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Failure, Graph, Variation
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.following import follow
from tests.sim.test_bodies import robot

RANGES = (
    Variation("actuator", "left_wheel", "thrust", 60.0, 200.0),
    Variation("actuator", "right_wheel", "delay", 0.0, 4.0),
    Variation("actuator", "claw", "noise", 0.0, 0.3),
    Variation("sensor", "eyes", "delay", 0.0, 3.0),
    Variation("sensor", "eyes", "lost", 0.0, 0.2),
    Variation("body", "", "density", 0.5, 3.0),
    Variation("body", "", "friction", 0.0, 1.0),
    Variation("body", "", "angular_damping", 1.0, 30.0),
    Variation("thing", "crate", "density", 0.1, 2.0),
    Variation("thing", "crate", "damping", 0.0, 9.0),
)
SEEDS = range(300)
CRATES = "contains rock is obstacle grid 10 size 2 to 4\n  contains crate is box size 1 to 3 count 3"


def varied(*varies: Variation, fails: tuple[Failure, ...] = (), ticks: int = 400) -> Graph:
    graph = robot("box", ticks, rocks=CRATES)
    return replace(graph, tasks=(replace(graph.tasks[0], varies=varies, fails=fails),))


def rollout(graph: Graph, **options: int) -> Rollout:
    return Rollout(Policy(graph, {}), "Drift", "Drift", **options)


@pytest.mark.parametrize("seed", range(2))
def test_every_tick_is_as_if_what_was_drawn_had_been_said(seed: int) -> None:
    graph = varied(*RANGES, fails=(Failure("left_wheel", 0.002), Failure("claw", 0.01)))
    follow(rollout(graph), Engine(Policy(graph, {})), seed)


def test_a_result_is_of_its_seed_alone() -> None:
    graph = varied(*RANGES, fails=(Failure("left_wheel", 0.01),), ticks=60)
    none, seeds = np.zeros((1, 0), np.float32), [3, 4, 5, 6, 7]
    alone = rollout(graph, lanes=1).score(none, seeds)
    for options in ({"lanes": 16}, {"lanes": 2}, {"lanes": 3, "workers": 2}):
        assert np.array_equal(alone.total, rollout(graph, **options).score(none, seeds).total), options


def test_the_world_is_the_same_without_what_varies_in_it() -> None:
    plain, run = (trace(rollout(graph), 7) for graph in (varied(), varied(*RANGES, fails=(Failure("claw", 0.1),))))
    assert np.array_equal(plain.boxes, run.boxes)
    assert np.array_equal(plain.things, run.things)
    assert np.array_equal(plain.begin, run.begin)
    assert len(plain.drawn) == 0


def test_all_of_a_range_is_drawn() -> None:
    """What is whole is drawn whole, both ends too; a chance of 5% in each tick lasts for 19 on average."""
    graph = varied(RANGES[0], RANGES[1], fails=(Failure("claw", 0.05),))
    thrust, delay, tick = np.array([trace(rollout(graph), seed).drawn for seed in SEEDS]).T
    assert thrust.min() >= 60.0
    assert thrust.max() <= 200.0
    assert abs(thrust.mean() - 130.0) < 8.0
    assert {*delay.tolist()} == {0.0, 1.0, 2.0, 3.0, 4.0}
    assert abs(tick.mean() - 19.0) < 4.0


@pytest.mark.parametrize(("rate", "tick"), [(1.0, 0), (0.0, 400)])
def test_what_must_fail_fails_at_once_and_what_cannot_never_does(rate: float, tick: int) -> None:
    assert trace(rollout(varied(fails=(Failure("claw", rate),))), 1).drawn.tolist() == [tick]
