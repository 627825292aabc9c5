"""What a person or a program wants of the robot."""

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Self

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Flaw, Row, Scene, SensorKind
from mindrun.numbers.quantity import Number, Quantity, Range, Ratio

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *

MAX_CHOICES = 1000
ONCE_TICKS = 1 << 62  # an order that is drawn anew after so many ticks is drawn once
PAUSE = Quantity("a time", {"s": 1.0}, low=0.0, high=1e9)


@kind("sensor", "order")
class Order(SensorKind):
    """An order from outside: `order 1 to 7` is one of seven, with a reading for each; `order 0 to 1` is a number.

    Of one of several, the reading of what is ordered is 1, all others are 0. A number reads 0 at the low end and 1 at
    the high end. On a robot it is what was said last (`mindrun order`), and `neutral` before anything was said, or
    after a silence of more than `timeout` (0: it stays). A neutral of 0 is none of several. In a task it is drawn when
    a run begins, and anew `every` so long (0: never); the share `lost` of them reads `neutral`.
    """

    order: Range
    neutral: Number = 0.0
    every: Annotated[float, PAUSE] = 0.0
    lost: Ratio = 0.0
    timeout: Annotated[float, PAUSE] = 0.0

    is_given = is_order = True
    needs_driver = False

    @property
    def choices(self) -> int:
        """The number of things of which one is ordered; 0 where a number is."""
        last = self.order.last
        return int(last) if self.order.first == 1 < last <= MAX_CHOICES and last == int(last) else 0

    @property
    def shape(self) -> tuple[int, ...]:
        return (self.choices,) if self.choices else ()

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        first, last = self.order.first, self.order.last
        if not first < last or self.order.by is not None:
            hint = "Write order 1 to 7 for one of seven, or order 0 to 1 for a number."
            return Flaw("open-range", "order", "An order has a range with two ends.", hint)
        if self.refusal(self.neutral):
            hint = "Write neutral 0 for none of them, or one of them." if self.choices else f"Write neutral {first:g}."
            return Flaw("not-an-order", "neutral", f"{self.neutral:g} is no order: {self.refusal(self.neutral)}.", hint)
        return None

    def refusal(self, value: float) -> str:
        """The reason why a number is no such order, empty where it is one."""
        first, last = self.order.first, self.order.last
        if self.choices:
            fits = value in range(self.choices + 1)
            return "" if fits else f"it is one of 1 to {self.choices}, or 0 for none of them"
        return "" if first <= value <= last else f"it is a number from {first:g} to {last:g}"

    def readings(self, value: float) -> tuple[float, ...]:
        """The readings of an order, each in 0..1."""
        if self.choices:
            return tuple(float(value == each) for each in range(1, self.choices + 1))
        return ((value - self.order.first) / (self.order.last - self.order.first),)

    @property
    def taught(self) -> Self:
        """The kind as training has it: nobody is silent there."""
        return replace(self, timeout=0.0)

    @property
    def numbers(self) -> tuple[float, ...]:  # type: ignore[override]
        """The share that is lost, then what is read of those."""
        return (self.lost, *self.readings(self.neutral))

    def row(self, scene: Scene) -> Row:
        return {"every": max(1, round(self.every / scene.tick)) if self.every else ONCE_TICKS}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Draw this turn's order of the run's seed, the sensor's number among orders and that of the turn alone."""
        lost = t.numbers[sensor.number]
        for p in range(n):
            seek(s.active, p, s.seed[p], sensor.part, 2 * (s.tick[p] // sensor.every))
            drawn, is_lost = uniform(s.active, p, 0.0, 1.0), uniform(s.active, p, 0.0, 1.0) < lost
            chosen = np.floor(drawn * sensor.width)
            for k in range(sensor.width):
                v = F(drawn) if sensor.width == 1 else ONE if k == chosen else ZERO
                s.readings[sensor.start + k, p] = F(t.numbers[sensor.number + 1 + k]) if is_lost else v
