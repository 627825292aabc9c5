"""The charge of the battery."""

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import BatteryModel, Begin, Bounds, Physical
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import RATE, RATIO

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import F


@kind("sensor", "battery")
class Battery(Physical):
    """Charge of the battery: `start`s there, loses `drain` every tick, gains `charge` every tick inside a `power`."""

    start: Annotated[float, RATIO] = 0.4
    drain: Annotated[float, RATE] = 0.00005
    charge: Annotated[float, RATE] = 0.005

    keeps_lost = True
    remedy = "Give it a drain above 0"

    @property
    def battery(self) -> BatteryModel:
        """The model of the battery, from the sensor's arguments."""
        return BatteryModel(self.start, self.drain, self.charge)

    def constant(self, world: WorldFacts) -> float | None:
        """The charge of a battery that nothing drains, and that nothing charges or that is full; else None."""
        is_still = self.drain == 0 and (self.start == 1 or not (self.charge and world.charges))
        return self.start if is_still else None

    def first(self, begin: Begin) -> Bounds:
        """The charge with which the battery starts, give or take the noise."""
        return self.around(self.start)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """The charge of each robot's battery, in float32."""
        for p in range(n):
            s.readings[sensor.start, p] = F(s.battery[p])
