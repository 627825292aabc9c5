"""How far a thing is in some directions: one line of a camera that sees its colour alone."""

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from mindrun.arithmetic import COSINE, MAX_FLOAT32, ONE, SINE, SIZE, THING_ROWS, ZERO, F, X, Y, clamp
from mindrun.quantity import ANGLE, POSITIVE, THING
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical, Row, Scene, World


@kind("sensor", "eye")
@dataclass(frozen=True, slots=True)
class Eye(Physical):
    """Distance from the body's rim to a thing, one reading per angle: 0 touching or inside, 1 where the ray meets none.

    A range finder that sees all things of that name and no other; an obstacle or a wall before one hides it. Angles
    turn counterclockwise from straight ahead. Of a box that can be pushed it sees the disc in it.
    """

    of: Annotated[str, THING]
    at: Annotated[tuple[float, ...], ANGLE] = (0.0,)
    range: Annotated[float, POSITIVE] = 30.0

    scaled = True
    pierces = True
    near = 0
    blank = 1.0
    remedy = "Let a task contain what it is about"

    @property
    def width(self) -> int:
        """One reading per angle."""
        return len(self.at)

    @property
    def rays(self) -> tuple[float, ...]:
        """Its angles."""
        return self.at

    @property
    def reach(self) -> float:
        """Its range."""
        return self.range

    def constant(self, world: World) -> float | None:
        """1 without the thing."""
        return None if self.of in world.things else 1.0

    def row(self, scene: Scene) -> Row:
        """How far it looks."""
        return {"range": self.range}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The distance along each ray to the thing that it meets first, if nothing solid comes before."""
        scale = ONE / F(sensor.range)
        for k in range(sensor.width):
            ray, out = sensor.ray + k, s.readings[sensor.start + k]
            for p in range(n):
                out[p] = MAX_FLOAT32
            cosine, sine = t.rays[COSINE, ray], t.rays[SINE, ray]
            for i in range(sensor.thing, sensor.thing + sensor.things):
                rows = s.things[THING_ROWS * i : THING_ROWS * (i + 1)]
                if t.things[i].is_round or t.things[i].loose >= 0:
                    meet_disc(s.body, s.heading, rows, cosine, sine, out, n)
                else:
                    meet_square(s.body, s.heading, rows, cosine, sine, out, n)
            solid, rim = s.sight[4 + ray], t.rims[ray]
            for p in range(n):
                out[p] = clamp((out[p] - rim) * scale) if out[p] <= solid[p] else ONE


def meet_disc(body: Any, heading: Any, thing: Any, cosine: Any, sine: Any, out: Any, n: Any) -> None:
    """`out` lowered to the distance from each robot's middle along a ray to a disc, where that is less."""
    for p in range(n):
        c = F(heading[COSINE, p]) * cosine - F(heading[SINE, p]) * sine
        s = F(heading[SINE, p]) * cosine + F(heading[COSINE, p]) * sine
        dx, dy, half = F(thing[X, p] - body[X, p]), F(thing[Y, p] - body[Y, p]), F(thing[SIZE, p] / 2)
        along, aside = c * dx + s * dy, c * dy - s * dx
        inner = half * half - aside * aside
        chord = F(np.sqrt(inner if inner > ZERO else ZERO))
        near = along - chord
        near = near if near > ZERO else ZERO
        out[p] = near if (inner >= ZERO) & (along + chord >= ZERO) & (near < out[p]) else out[p]


def meet_square(body: Any, heading: Any, thing: Any, cosine: Any, sine: Any, out: Any, n: Any) -> None:
    """The same to a square (the slab method)."""
    for p in range(n):
        ix = ONE / (F(heading[COSINE, p]) * cosine - F(heading[SINE, p]) * sine)
        iy = ONE / (F(heading[SINE, p]) * cosine + F(heading[COSINE, p]) * sine)
        dx, dy, half = F(thing[X, p] - body[X, p]), F(thing[Y, p] - body[Y, p]), F(thing[SIZE, p] / 2)
        left, right, low, high = (dx - half) * ix, (dx + half) * ix, (dy - half) * iy, (dy + half) * iy
        enter_x, leave_x = (left, right) if left < right else (right, left)
        enter_y, leave_y = (low, high) if low < high else (high, low)
        enter = enter_x if enter_x > enter_y else enter_y
        leave = leave_x if leave_x < leave_y else leave_y
        near = enter if enter > ZERO else ZERO
        out[p] = near if (enter <= leave) & (leave >= ZERO) & (near < out[p]) else out[p]
