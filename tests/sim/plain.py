"""A plain pymunk loop for the physics: what the lanes are held against, written with pymunk's own classes only."""

import math
from collections.abc import Sequence

import pymunk

DT = 1 / 60
LINEAR, ANGULAR = 1 / (1 + DT * 5), 1 / (1 + DT * 20)
CATCH = 0.2


class PlainRobot:
    """The paper's robot in one Space of its own, with squares, walls and what the claw may hold."""

    def __init__(self, pose: Sequence[float], boxes: Sequence[Sequence[float]], half: float | None, item: float = 0.0):
        self.space = pymunk.Space()
        self.space.iterations = 8
        self.space.use_spatial_hash(20.0, 20)
        for x, y, h, *_ in boxes:
            self._box(x - h, y - h, x + h, y + h)
        if half is not None:
            a, b = half, half + 2
            self._box(-b, -b, -a, b)
            self._box(a, -b, b, b)
            self._box(-b, -b, b, -a)
            self._box(-b, a, b, b)
        self.body = pymunk.Body(2 * math.pi * 1.0**2, 2 * math.pi / 2)
        self.body.position, self.body.angle = (pose[0], pose[1]), pose[2]
        circle = pymunk.Circle(self.body, 1.0)
        circle.friction = CATCH
        self.space.add(self.body, circle)
        self.item = None
        if item:
            self.item = pymunk.Circle(self.body, item / 2, (1 + item / 2, 0))
            self.item.friction = CATCH
            self.item.sensor = True
            self.space.add(self.item)

    def _box(self, left: float, low: float, right: float, high: float) -> None:
        shape = pymunk.Poly(self.space.static_body, [(left, low), (right, low), (right, high), (left, high)])
        shape.friction = 1.0
        self.space.add(shape)

    def step(self, left: float, right: float, cosine: float, sine: float, holds: bool = False) -> tuple[float, ...]:
        """One tick under two wheel commands; heading as the lanes see it."""
        if self.item:
            self.item.sensor = not holds
        body = self.body
        a, b = (2.0 * left - 1.0) * 80.0, (2.0 * right - 1.0) * 80.0
        force, torque = a + b, -a + b
        body.velocity = (body.velocity.x * LINEAR, body.velocity.y * LINEAR)
        body.angular_velocity *= ANGULAR
        body.force, body.torque = (force * cosine, force * sine), torque
        self.space.step(DT)
        return (*body.position, body.angle, *body.velocity, body.angular_velocity)
