"""What other robots say."""

from math import inf
from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Physical, Row, Scene
from mindrun.numbers.quantity import Length, ThingName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from mindrun.numbers.arithmetic import *


@kind("sensor", "signal")
class Signal(Physical):
    """What the nearest robot of a name says: the command of its actuator `signal` in the tick before, else 0.

    It is 0, too, where none of them is within `range`, and in the first tick.
    """

    of: ThingName
    range: Length = 0.0

    is_about = staticmethod(lambda kind: kind.is_robot)

    def row(self, scene: Scene) -> Row:
        return {**Physical.row(self, scene), "range": self.range or inf}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        for p in range(n):
            value, least = ZERO, sensor.range
            for number in range(len(t.robots)):
                i = t.robots[number].thing
                if (sensor.thing <= i) & (i < sensor.thing + sensor.things):
                    far = distance_of(s.things, i, p)
                    value, least = (s.said[number, p], far) if far <= least else (value, least)
            out[p] = value
