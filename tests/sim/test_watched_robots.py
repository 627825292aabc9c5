"""A run with several robots, watched through any of them: what is written down is its lane, and the world of all."""

import numpy as np
import pytest
from mindrun.engine.changes import Change, What
from mindrun.numbers.arithmetic import ANGLE, Y, place_of
from mindrun.sim.numbering import robot_numbers
from mindrun.sim.trace import Ticks, joined, trace

from tests.sim.test_teams import ROCKS, drifters, ticks

ROBOTS, TICKS, SEED = 4, 2_000, 0


@pytest.fixture(scope="module")
def watched() -> list[Ticks]:
    """The ticks of one run, through each of its robots."""
    rollout = drifters(ROBOTS - 1, ROCKS, 4)
    return [joined(trace(rollout, SEED, robot=robot).chunks) for robot in range(ROBOTS)]


def test_a_trace_through_a_robot_has_its_lane_and_shows_the_others(watched: list[Ticks]) -> None:
    rollout = drifters(ROBOTS - 1, ROCKS, 4)
    run, carried = ticks(rollout, SEED), 0
    state = next(run).state
    things = state.world.things
    for number in range(TICKS):
        next(run)
        for robot, its in enumerate(watched):
            assert np.array_equal(its.readings[number], state.mind.readings[:, robot], equal_nan=True)
            assert np.array_equal(its.commands[number], state.mind.commands[: its.commands.shape[1], robot])
            assert np.array_equal(its.body[number], state.world.body[:, robot])
            assert its.held[number] == state.world.held[robot]
            for row, other in robot_numbers(rollout.task).items():
                place = np.full(2, np.nan) if other == robot else state.world.body[: Y + 1, other]
                assert np.array_equal(its.things[number, row, : Y + 1], place, equal_nan=True)
                assert its.turned[number, row] == state.world.body[ANGLE, other]
            for holder in np.flatnonzero(state.world.held[:ROBOTS] >= 0):
                thing = state.world.held[holder]
                assert np.array_equal(its.things[number, thing, : Y + 1], place_of(things, thing, holder))
                carried += holder != robot
    assert carried


@pytest.mark.parametrize("what", ["reading", "influence"])
def test_a_change_is_made_in_the_mind_of_the_robot_that_is_watched(watched: list[Ticks], what: What) -> None:
    rollout, robot, tick = drifters(ROBOTS - 1, ROCKS, 4), 2, 100
    others, was = [row for row, number in robot_numbers(rollout.task).items() if number != robot], watched[robot]
    now = joined(trace(rollout, SEED, changes=(Change(what, 0, (0.125,), tick, tick),), robot=robot).chunks)
    assert getattr(now, "readings" if what == "reading" else "influence")[tick - 1, 0] == np.float32(0.125)
    if what == "reading":  # a single skill has all influence, however little
        assert not np.array_equal(now.commands[tick - 1], was.commands[tick - 1])
        assert not np.array_equal(now.body[tick - 1], was.body[tick - 1])
    assert np.array_equal(now.body[: tick - 1], was.body[: tick - 1])
    assert np.array_equal(now.things[:tick, others], was.things[:tick, others])  # the others know nothing of it yet
