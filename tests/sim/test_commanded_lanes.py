"""Runs commanded from outside: what Rollout makes of their seeds, whatever lane they are in and whenever they begin."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.weights import reachable, weights_of
from mindrun.kinds.functions.function import Stateful
from mindrun.sim.codes import FAR
from mindrun.sim.commanded_lanes import CommandedLanes, CommandedWorld, commanded_lanes
from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import load
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.minds import compile_text
from tests.sim.test_random_worlds import SLOW, Weights, weights_for
from tests.sim.test_rollout import COLLECT
from tests.sim.test_teams import TOGETHER
from tests.sim.worlds import random_world

SEEDS = [3, 2**64 - 1, 0, 7, 11]
Think = Callable[[CommandedLanes], None]


def run_all(lanes: CommandedLanes, think: Think, check: Callable[[int, int], None]) -> None:
    """Every seed in one of the lanes, the next where a run has ended; `check` is told a seed's place and its lane."""
    waiting, count = list(range(len(SEEDS))), lanes.count
    runs = [waiting.pop(0) for _ in range(count)]
    lanes.begin(np.ones(count, np.bool_), [SEEDS[run] for run in runs])
    while any(run >= 0 for run in runs):
        lanes.sense()
        think(lanes)
        lanes.act()
        over = lanes.terminated | lanes.timed_out
        for lane in np.flatnonzero(over & (np.array(runs) >= 0)).tolist():
            check(runs[lane], lane)
            runs[lane] = waiting.pop(0) if waiting else -1
            if runs[lane] >= 0:
                lanes.begin(np.arange(count) == lane, [SEEDS[runs[lane]]])


def checked(lanes: CommandedLanes, scores: Scores) -> Callable[[int, int], None]:
    def check(run: int, lane: int) -> None:
        total = lanes.scores[lane]
        assert (total if np.isfinite(total) else -np.inf) == scores.total[0, run]
        assert np.array_equal(lanes.lines[lane], scores.by_line[0, run], equal_nan=True)
        assert np.array_equal(lanes.counts[lane], scores.by_event[0, run])
        assert lanes.ended_by[lane] == scores.ended_by[0, run]

    return check


def player(skill: Skill, weights: Weights, row: int) -> Think:
    """A program that computes what the skill would; as in the lanes, only where all of its inputs are finite."""
    compute = skill.function.ready(len(skill.inputs), skill.outputs, weights_of(skill, weights), {})

    def think(lanes: CommandedLanes) -> None:
        inputs = lanes.state.mind.readings[list(skill.inputs), : lanes.lanes].T
        with np.errstate(all="ignore"):
            lanes.play(row, np.array([compute(np.ascontiguousarray(each)) for each in inputs], np.float32))

    return think


def whole(lanes: CommandedLanes) -> None:
    lanes.rollout.think(lanes.tile, lanes.jobs, 0, len(lanes.rollout.tables.skills))


def playable(graph: Graph, weights: Weights) -> list[Skill]:
    """Skills that weights make, whose function remembers nothing: that is the player's affair."""
    reached = reachable(graph, graph.master)
    shared = [skill.owner for skill in reached]
    chosen = [s for s in reached if s.outputs and s.function.learns and not s.like and shared.count(s.name) == 1]
    ready = {s.name: s.function.ready(len(s.inputs), s.outputs, weights_of(s, weights), {}) for s in chosen}
    return [skill for skill in chosen if not isinstance(ready[skill.name], Stateful)]


@settings(max_examples=cases(40), suppress_health_check=SLOW)
@given(random_world(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1), st.integers(1, 3))
def test_runs_are_those_of_a_rollout(graph: Graph, scale: float, seed: int, count: int) -> None:
    """Of the whole mind, and of one of which a skill is played from outside."""
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    policy, none = Policy(graph, weights), np.zeros((1, 0), np.float32)
    rollout = Rollout(policy, "World", graph.master, procedures=PROCEDURES)
    scores = rollout.score(none, SEEDS)
    lanes = CommandedLanes(rollout, count)
    run_all(lanes, whole, checked(lanes, scores))
    for skill in playable(graph, weights)[:1]:
        event("a skill is played")
        played = Rollout(policy, "World", graph.master, [skill.name], procedures=PROCEDURES)
        row = played.tables.skills["index"].tolist().index(graph.skill_numbers[skill.name])
        lanes = CommandedLanes(played, count)
        run_all(lanes, player(skill, weights, row), checked(lanes, scores))


CROWD = """task Crowd in arena size 14
  contains mate is robot count 2
  contains object is item size 1
  lasts 200 ticks
  rewards progress toward object per tick
  rewards 0.3 on collision with mate
  rewards -1 on collision
  ends on 2 collision with mate
"""


@pytest.mark.parametrize("count", [1, 2, 3])
def test_runs_of_several_robots_are_those_of_a_rollout(count: int) -> None:
    rollout = Rollout(Policy(compile_text(TOGETHER + CROWD), {}), "Crowd", "Drift")
    scores, ends = rollout.score(np.zeros((1, 0), np.float32), SEEDS), set()
    lanes = CommandedLanes(rollout, count)
    right = checked(lanes, scores)

    def check(run: int, lane: int) -> None:
        right(run, lane)
        paid = lanes.paid.reshape(count, 3)[lane]
        assert paid.mean() == pytest.approx(lanes.scores[lane])
        assert len({*paid}) > 1
        ends.add(int(lanes.ended_by[lane]))

    run_all(lanes, whole, check)
    assert ends == {0, -1}


@pytest.mark.parametrize("count", [3, 1])
def test_a_run_has_ended_where_one_of_its_robots_is_beyond_all_places(count: int) -> None:
    lanes = commanded_lanes(compile_text(TOGETHER + CROWD), "Crowd", "Drift", count)
    ahead = np.tile(np.array([0.9, 0.8, 0.0], np.float32), (lanes.lanes, 1))
    lost, robot = np.arange(count) == count // 2, 3 * (count // 2) + 1
    lanes.begin(np.ones(count, np.bool_), SEEDS[:count])
    for tick in range(40):
        if tick == 39:
            lanes.state.world.body[0, robot] = 2 * FAR
        lanes.sense()
        lanes.command(ahead)
        lanes.act()
    assert lanes.terminated.tolist() == lost.tolist()
    assert lanes.ended_by.tolist() == np.where(lost, -2, -1).tolist()
    assert lanes.paid.reshape(count, 3).mean(axis=1) == pytest.approx(lanes.scores)
    assert len({*lanes.paid}) == (7 if count > 1 else 3)  # where another run has its lanes, robots are not known apart
    lanes.begin(lost, [9])
    assert not lanes.terminated.any()
    assert lanes.state.world.tick.tolist() == np.repeat(np.where(lost, 0, 40), 3).tolist()


def test_a_single_engine_commands_no_world_of_several_robots() -> None:
    with pytest.raises(MindError, match=r"^Crowd has 3 robots, and only one can be commanded here$"):
        CommandedWorld(compile_text(TOGETHER + CROWD), "Crowd", 1)


def driven(lanes: CommandedLanes, ticks: int, aside: bool) -> np.ndarray:
    """What is read in so many ticks under some commands."""
    actuators = len(lanes.rollout.graph.actuators)
    commands = np.random.default_rng(1).random((ticks, lanes.lanes, actuators)).astype(np.float32)
    found, runs = [], np.arange(lanes.count) % 2 == 1
    for now in commands:
        if aside:
            seen = lanes.sensed_aside(runs)
            expected = seen.mind.readings[:, : lanes.lanes // 2].copy()
        lanes.sense()
        found.append(lanes.state.mind.readings[:, : lanes.lanes].copy())
        if aside:
            assert np.array_equal(expected, found[-1][:, np.repeat(runs, lanes.robots)])
        lanes.command(now)
        lanes.act()
    return np.array(found)


def test_what_is_sensed_aside_is_what_would_be_sensed_and_changes_nothing() -> None:
    graph = load(COLLECT.with_name("ball.mind")).graph
    assert graph
    for mind, task in ((graph, "Reach"), (compile_text(TOGETHER + CROWD), "Crowd")):
        readings = [driven(commanded_lanes(mind, task, mind.master, 6), 200, aside) for aside in (False, True)]
        assert np.array_equal(*readings, equal_nan=True)
        assert (readings[0] != readings[0][0]).any()


def test_a_robot_beyond_all_places_has_ended_and_the_next_run_is_right() -> None:
    graph = load(COLLECT).graph
    assert graph
    lanes, alone = (commanded_lanes(graph, "GoToObject", "GoToObject", count) for count in (3, 1))
    third = np.array([False, False, True])
    lanes.begin(~third, [5, 6])
    lanes.begin(third, [7])
    lanes.sense()
    lanes.state.world.body[0, 1] = 2 * FAR
    neutral = np.full((3, 3), 0.5, np.float32)
    lanes.command(neutral)
    lanes.act()
    assert lanes.terminated.tolist() == [False, True, False]
    assert lanes.ended_by.tolist() == [-1, -2, -1]
    lanes.begin(lanes.terminated, [9])
    alone.begin(np.ones(1, np.bool_), [9])
    assert not lanes.terminated.any()
    for _ in range(20):
        for each in (lanes, alone):
            each.sense()
            each.command(neutral[: each.count] * 1.4)
            each.act()
        assert np.array_equal(lanes.state.world.body[:, 1], alone.state.world.body[:, 0])
    assert lanes.state.world.tick.tolist() == [21, 20, 21]
