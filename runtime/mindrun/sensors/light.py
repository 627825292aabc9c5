"""How bright a thing is from where the robot is."""

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from mindrun.arithmetic import BOX_COLUMNS, DISTANCE, HALF_X, HALF_Y, ZERO, F, X, Y, nearest
from mindrun.quantity import POSITIVE, THING
from mindrun.registry import kind
from mindrun.sensors.sensor import Physical, Row, Scene, World


@kind("sensor", "light")
@dataclass(frozen=True, slots=True)
class Light(Physical):
    """Light of a thing, of several the nearest: 1 at its middle, 0.5 at `range`, far away falling with the square.

    1 / (1 + (distance of the middles / range)²); 0 without it, and where an obstacle stands between the middles.
    """

    of: Annotated[str, THING]
    range: Annotated[float, POSITIVE] = 10.0

    near = 1
    remedy = "Let a task contain what it is about"

    def constant(self, world: World) -> float | None:
        """0 without the thing."""
        return None if self.of in world.things else 0.0

    def row(self, scene: Scene) -> Row:
        """Where it reads half."""
        return {"range": self.range}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The square law, and nothing in the shadow."""
        out = s.readings[sensor.start]
        if sensor.things == 0:
            for p in range(n):
                out[p] = ZERO
            return
        thing = nearest(s, sensor, n)
        x, y, away = thing[X], thing[Y], thing[DISTANCE]
        for p in range(n):
            share = away[p] / sensor.range
            v = F(1.0 / (1.0 + share * share))
            is_dark = np.isnan(share) or is_shaded(s.boxes, s.body[X, p], s.body[Y, p], x[p], y[p], p)
            out[p] = ZERO if is_dark else v


def is_shaded(boxes: Any, x: Any, y: Any, to_x: Any, to_y: Any, p: Any) -> Any:
    """Whether a box of lane p meets the straight line from one place to the other: no axis separates them."""
    half_x, half_y = (to_x - x) / 2, (to_y - y) / 2
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        dx, dy = x + half_x - boxes[p, box + X], y + half_y - boxes[p, box + Y]
        wide, high = boxes[p, box + HALF_X], boxes[p, box + HALF_Y]
        if (
            abs(dx) <= wide + abs(half_x)
            and abs(dy) <= high + abs(half_y)
            and abs(half_x * dy - half_y * dx) <= high * abs(half_x) + wide * abs(half_y)
        ):
            return True
    return False
