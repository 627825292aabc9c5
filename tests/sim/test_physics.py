"""Free flight and contacts equal a loop of plain pymunk, bit for bit."""

import numpy as np
import pymunk
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.lanes.nearest_points import nearest_points
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.minds import drifter
from tests.sim.plain import PlainRobot


@pytest.mark.parametrize("seed", range(5))
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


@pytest.mark.parametrize(
    ("rocks", "seed"), [(rocks, seed) for rocks in (ROCKS, THICKET, SCATTERED) for seed in range(8)]
)
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


@pytest.mark.parametrize("seed", range(4))
def test_a_space_makes_the_same_contacts(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """It does where the C library has no `sincos`, with which Chipmunk turns what is held."""

    def bodies() -> list[bytes]:
        rollout = Rollout(Policy(drifter("arena", 3_000, ROCKS), {}), "Drift", "Drift", interrupt=False)
        alone.append(bool(rollout.tables.world[0]["is_alone"]))
        return [moment.body.tobytes() for moment in trace(rollout, seed).moments]

    alone = list[bool]()
    made = bodies()
    monkeypatch.setattr("mindrun.sim.chipmunk_internals._address_in_c", lambda name: 0)
    assert bodies() == made
    assert alone == [True, False]


PLACES = st.floats(-3, 3) | st.sampled_from([-1.0, -0.5, 0.0, 0.5, 1.0])  # on edges, corners and in the middle, too


@given(x=PLACES, y=PLACES, wide=st.floats(0.1, 2), high=st.floats(0.1, 2), radius=st.floats(0.05, 3))
@example(x=0.0, y=0.0, wide=1.0, high=1.0, radius=1.0)
@example(x=0.5, y=0.25, wide=0.5, high=2.0, radius=0.1)
def test_a_disc_meets_a_box_where_chipmunk_says(x: float, y: float, wide: float, high: float, radius: float) -> None:
    """Beside it, at a corner, and with its middle inside."""
    box = pymunk.Poly(pymunk.Space().static_body, [(-wide, -high), (wide, -high), (wide, high), (-wide, high)])
    disc = pymunk.Circle(pymunk.Body(1, 1), radius)
    disc.body.position = x, y
    disc.cache_bb(), box.cache_bb()
    own_x, own_y, its_x, its_y, normal_x, normal_y, apart = nearest_points(x, y, radius, -wide, -high, wide, high)
    if apart > radius:
        with pytest.raises(AssertionError):  # pymunk's own, where there is no contact
            disc.shapes_collide(box)
        return
    said = disc.shapes_collide(box)
    (point,) = said.points
    assert said.normal == (normal_x, normal_y)
    assert point.point_a == (own_x + normal_x * radius, own_y + normal_y * radius)
    assert point.point_b == (its_x, its_y)
