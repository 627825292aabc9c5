"""The charge of the battery."""

from typing import TYPE_CHECKING, Annotated, Any, Self

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import RATE, Ratio

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import *


@kind("sensor", "battery")
class Battery(Physical):
    """Charge of the battery: `start`s there, loses `drain` every tick, gains `charge` every tick inside a `power`."""

    start: Ratio = 0.4
    drain: Annotated[float, RATE] = 0.00005
    charge: Annotated[float, RATE] = 0.005

    keeps_lost = True
    remedy = "Give it a drain above 0"

    @property
    def battery(self) -> Self:
        return self

    def constant(self, world: WorldFacts) -> float | None:
        is_still = self.drain == 0 and (self.start == 1 or not (self.charge and world.charges))
        return self.start if is_still else None

    def first(self, begin: Begin) -> Bounds:
        return self.around(self.start)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for p in range(n):
            s.readings[sensor.start, p] = F(s.battery[p])
