"""The simulator held against pymunk on this machine: in both a robot pushes boxes about, bit for bit."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
import pymunk
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, Trace, trace

from mindlang.api import loads

HALF_SIDE, RUN_TICKS = 6.0, 1200
REST_SPEED = 1e-3  # units and radians per second, below which a box stands still
ROBOT_FRICTION = 0.2
PUSHING_SEED = 2  # all three boxes are pushed, turned, and pressed against others
MIND = f"""
tick 1/60 s
master Push
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor slow is sine period 7.3 s
sensor quick is sine period 3.1 s
sensor odd is sine period 2.77 s
skill Push is rule
  reads slow
  reads quick
  reads odd
  drives left_wheel at 1.5 * quick - slow + 0.4
  drives right_wheel at 1.5 * quick - odd + 0.4
task World in arena size {2 * HALF_SIDE}
  contains rock is obstacle grid 6 size 1 jitter 1
  contains crate is box size 2 count 3 density 0.5 friction 0.5 damping 2
  lasts {RUN_TICKS} ticks
  rewards 1 per tick
"""


def differing_tick(seed: int) -> int:
    """The first tick after which the robot or a box is not where pymunk has it, 0 where there is none."""
    run = trace(world(), seed)
    plain = PlainSpace(run)
    return next((moment.tick for moment in run.moments if not plain.follows(moment)), 0)


def world() -> Rollout:
    """The world of MIND, in which the robot pushes boxes against each other, rocks and walls."""
    return Rollout(Policy(loads(MIND).graph, {}), "World", "Push")


class PlainSpace:
    """The world of MIND in a Space of pymunk, with pymunk's own classes only."""

    def __init__(self, run: Trace) -> None:
        self.space = arena(run.boxes, HALF_SIDE)
        self.robot, self.boxes = disc(self.space, run.begin.tolist()), []
        for x, y, size in run.things:
            box, half = pymunk.Body(0.5 * size**2, 0.5 * size**2 * (size**2 + size**2) / 12), size / 2
            box.position = x, y
            self.boxes.append(box)
            self.space.add(box)
            add(self.space, pymunk.Poly(box, corners(-half, -half, half, half)), 0.5)

    def follows(self, moment: Moment) -> bool:
        """Make the tick of a moment; True if all ends where the moment has it."""
        left, right = moment.acting.tolist()
        drive(self.robot, left, right, cosine(self.robot.angle), sine(self.robot.angle))
        for box in self.boxes:
            _slow(box, 1 / (1 + 2 / 60), 1 / (1 + 2 / 60))
            _rest(box)
        self.space.step(1 / 60)
        for box in self.boxes:
            _rest(box)
        bodies = [self.robot, *self.boxes]
        places = [(*body.position, body.angle) for body in bodies]
        return np.array_equal(places, [moment.body[:3], *np.c_[moment.things[:, :2], moment.turned]])


def arena(boxes: Iterable[Sequence[float]], half: float | None) -> pymunk.Space:
    """A Space as the lanes have it, with boxes (x, y, half of both sides) and, `half` from its middle, four walls."""
    space = pymunk.Space()
    space.iterations = 8
    space.use_spatial_hash(20.0, 20)
    sides = [(x - wide, y - high, x + wide, y + high) for x, y, wide, high in boxes]
    if half is not None:
        far = half + 2
        sides += [(-far, -far, -half, far), (half, -far, far, far), (-far, -far, far, -half), (-far, half, far, far)]
    for each in sides:
        add(space, pymunk.Poly(space.static_body, corners(*each)), 1.0)
    return space


def disc(space: pymunk.Space, begin: Sequence[float]) -> pymunk.Body:
    """The paper's robot, in a Space at a place with an angle."""
    body = pymunk.Body(2 * math.pi, math.pi)
    body.position, body.angle = (begin[0], begin[1]), begin[2]
    space.add(body)
    add(space, pymunk.Circle(body, 1.0), ROBOT_FRICTION)
    return body


def add(space: pymunk.Space, shape: pymunk.Shape, friction: float) -> None:
    """Add a shape of such a friction."""
    shape.friction = friction
    space.add(shape)


def corners(left: float, low: float, right: float, high: float) -> list[tuple[float, float]]:
    """The corners of a rectangle."""
    return [(left, low), (right, low), (right, high), (left, high)]


def drive(body: pymunk.Body, left: float, right: float, c: float, s: float) -> None:
    """Let a robot's wheels act for one tick under two commands, along its heading: a cosine and a sine."""
    a, b = (2.0 * left - 1.0) * 80.0, (2.0 * right - 1.0) * 80.0
    _slow(body, 1 / (1 + 5 / 60), 1 / (1 + 20 / 60))
    body.force, body.torque = ((a + b) * c, (a + b) * s), b - a


def _slow(body: pymunk.Body, share: float, turning_share: float) -> None:
    body.velocity = body.velocity.x * share, body.velocity.y * share
    body.angular_velocity *= turning_share


def _rest(body: pymunk.Body) -> None:
    if max(abs(body.velocity.x), abs(body.velocity.y), abs(body.angular_velocity)) < REST_SPEED:
        body.velocity, body.angular_velocity = (0.0, 0.0), 0.0
