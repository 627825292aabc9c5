"""Contacts of two shapes of any kind: where plain pymunk says, bit for bit."""

from dataclasses import dataclass
from functools import cache
from math import pi

import pymunk
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mindrun.sim.lanes.meeting import meet
from mindrun.sim.lanes.solids import put_corners, put_shape, turn
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import FIXED, HELD, ContactState

from tests.sim.plain_loose import corners
from tests.sim.test_loose import world

PLACES = st.floats(-3, 3) | st.sampled_from([-1.0, -0.5, 0.0, 0.5, 1.0])  # on edges, corners and in the middle, too
ANGLES = st.floats(-7, 7) | st.sampled_from([0.0, pi / 2, pi / 4, -pi])
HALVES = st.floats(0.05, 3) | st.sampled_from([0.5, 1.0])


@dataclass(frozen=True)
class Shape:
    """A ball, or a box that is turned; one that is `fixed` never moves."""

    is_round: bool
    half: float
    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0
    is_fixed: bool = False

    def plain(self, space: pymunk.Space) -> pymunk.Shape:
        """One of pymunk."""
        body = space.static_body if self.is_fixed else pymunk.Body(1, 1)
        if not self.is_fixed:
            body.position, body.angle = (self.x, self.y), self.angle
        found = pymunk.Circle(body, self.half) if self.is_round else pymunk.Poly(body, corners(self.half))
        found.cache_bb()
        return found

    def write(self, rollout: Rollout, contact: ContactState, a: int) -> None:
        """As solid `a` of the first lane."""
        solid = contact.solids[0, a]
        solid.is_round, solid.radius, solid.number, solid.cosine = self.is_round, self.half, a, 1.0
        solid.body, solid.robot = a, -1
        put_corners(solid.own_corners, -self.half, -self.half, self.half, self.half)
        turn(rollout.tables, solid, self.angle)
        solid.middle_x, solid.middle_y = self.x, self.y
        put_shape(solid, self.x, self.y)


shapes = st.builds(Shape, st.booleans(), HALVES, PLACES, PLACES, ANGLES)
fixed = st.builds(Shape, st.just(False), HALVES, is_fixed=st.just(True))


@cache
def loose_world() -> Rollout:
    return world(10)


@given(one=shapes, other=shapes | fixed)
@example(one=Shape(True, 1.0), other=Shape(False, 1.0, is_fixed=True))
@example(one=Shape(True, 0.1, 0.5, 0.25), other=Shape(False, 2.0, is_fixed=True))
@example(one=Shape(False, 1.0), other=Shape(False, 1.0))
@example(one=Shape(False, 1.0, 0.0, 2.0), other=Shape(False, 1.0))
@example(one=Shape(False, 1.0, 1.5, 0.3, 0.1), other=Shape(False, 1.0, is_fixed=True))
@example(one=Shape(True, 1.0), other=Shape(True, 1.0))
@example(one=Shape(True, 1.0, 0.5, 0.5), other=Shape(True, 0.5))
def test_two_shapes_meet_where_chipmunk_says(one: Shape, other: Shape) -> None:
    rollout = loose_world()
    contact = rollout.tile(1).state.contact
    a, b = HELD + 1, FIXED if other.is_fixed else HELD + 2  # both loose
    one.write(rollout, contact, a)
    other.write(rollout, contact, b)
    meet(contact, a, b, b, 0)
    first, last = (other, one) if other.is_round and not one.is_round else (one, other)  # as Chipmunk sorts them
    space = pymunk.Space()
    shape, its_shape = first.plain(space), last.plain(space)
    if contact.space[0].touching == 0:
        with pytest.raises(AssertionError):  # pymunk's own, where there is no contact
            shape.shapes_collide(its_shape)
        return
    said, pair = shape.shapes_collide(its_shape), contact.pairs[0, 0]
    assert said.normal == (pair.normal_x, pair.normal_y)
    assert len(said.points) == pair.count
    for point, found in zip(said.points, pair.contacts, strict=False):
        assert point.point_a - (first.x, first.y) == (found.x, found.y)
        assert point.point_b - (last.x, last.y) == (found.its_x, found.its_y)
