"""A plain pymunk loop for the physics: what the lanes are held against, written with pymunk's own classes only."""

from collections.abc import Sequence

import pymunk

from mindlang.physics_check import ROBOT_FRICTION, add, arena, disc, drive


class PlainRobot:
    """The paper's robot in one Space of its own, with rectangles, walls and what the claw may hold."""

    def __init__(self, pose: Sequence[float], boxes: Sequence[Sequence[float]], half: float | None, item: float = 0.0):
        self.space = arena(boxes, half)
        self.body = disc(self.space, pose)
        self.item = None
        if item:
            self.item = pymunk.Circle(self.body, item / 2, (1 + item / 2, 0))
            self.item.sensor = True
            add(self.space, self.item, ROBOT_FRICTION)

    def step(self, left: float, right: float, cosine: float, sine: float, holds: bool = False) -> tuple[float, ...]:
        """One tick under two wheel commands; heading as the lanes see it."""
        if self.item:
            self.item.sensor = not holds
        drive(self.body, left, right, cosine, sine)
        self.space.step(1 / 60)
        return (*self.body.position, self.body.angle, *self.body.velocity, self.body.angular_velocity)
