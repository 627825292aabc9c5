"""The speed of a wheel, as its encoder counts it."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.actuators.actuator import SIDE, Side
from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import POSITIVE

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import COSINE, HALF, SINE, SPEED_X, SPEED_Y, SPIN, F, clamp


@kind("sensor", "odometer")
class Odometer(Physical):
    """Speed of a wheel on the body's rim, as its encoder counts it: 0.5 standing, 1 forward with `range` units/s.

    0.5 + 0.5 · (distance a second) / range, 0 backward; the wheel rolls as its side of the body moves along the heading
    and never slips. The driver `encoder` measures it with `measure: speed`.
    """

    side: Annotated[Side, SIDE]
    range: Annotated[float, POSITIVE] = 10.0

    scaled = True
    unit = "m/s"
    blank = rest = still = 0.5

    def row(self, scene: Scene) -> Row:
        """The gain of a unit a second, and the side as `part`: −1 left, 1 right."""
        return {"gain": 0.5 / self.range, "part": 1 if self.side == "right" else -1}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """0.5 + (speed ± spin · arm) · gain."""
        arm = t.world[0].side if sensor.part > 0 else -t.world[0].side
        out, x, y, spin = s.readings[sensor.start], s.body[SPEED_X], s.body[SPEED_Y], s.body[SPIN]
        for p in range(n):
            ahead = x[p] * s.heading[COSINE, p] + y[p] * s.heading[SINE, p] + arm * spin[p]
            out[p] = clamp(HALF + F(ahead * sensor.gain))
