"""Free flight and contacts equal a loop of plain pymunk, bit for bit."""

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.draws import first
from tests.sim.minds import drifter
from tests.sim.plain import PlainRobot


@pytest.mark.parametrize("seed", first(2, range(5)))
def test_free_flight_equals_space_step(seed: int) -> None:
    rollout = Rollout(Policy(drifter(scene="plain", ticks=10_000), {}), "Drift", "Drift")
    run = trace(rollout, seed)
    plain = PlainRobot(run.begin, [], None)
    angle = run.begin[2]
    for moment in run.moments:
        left, right = (float(v) for v in moment.commands[:2])
        state = plain.step(left, right, cosine(angle), sine(angle))
        assert state == tuple(moment.body)
        angle = moment.body[2]
    assert moment.tick == 10_000


ROCKS, THICKET = "grid 10 size 2 to 4 jitter 1", "grid 2.6 size 0.5 to 2 jitter 0.3"
SCATTERED = "grid 7 size 2 to 3 jitter 1"  # 25: with the walls so many that Chipmunk asks what is held before the robot


@pytest.mark.parametrize("rocks", [ROCKS, THICKET, SCATTERED])
@pytest.mark.parametrize("seed", first(3, range(8)))
def test_contacts_equal_plain_pymunk(rocks: str, seed: int) -> None:
    """A robot that drives into obstacles, walls and corners, with and without an item in its claw; several at once."""
    rollout = Rollout(Policy(drifter("arena", 5_000, rocks), {}), "Drift", "Drift", interrupt=False)
    run = trace(rollout, seed)
    plain = PlainRobot(run.begin, run.boxes, 20.0, item=1.0)
    angle, touched, carried = run.begin[2], 0, 0
    for moment in run.moments:
        left, right = (float(v) for v in moment.commands[:2])
        holds = moment.held >= 0
        state = plain.step(left, right, cosine(angle), sine(angle), holds)
        assert np.array_equal(state, moment.body), f"tick {moment.tick}"
        angle = moment.body[2]
        touched += moment.touching
        carried += holds
    assert touched > 20


def test_a_run_with_more_contacts_than_there_is_room_for_ends_as_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.sim.state.MOST_PAIRS", 1)
    scores = Rollout(Policy(drifter("arena", 5_000, THICKET), {}), "Drift", "Drift", interrupt=False).score(
        np.zeros((1, 0), np.float32), range(8)
    )
    assert (scores.ended_by == -2).any()
    assert ((scores.faults > 0) == (scores.ended_by == -2)).all()
