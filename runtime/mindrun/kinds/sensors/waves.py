"""Sensors that go by time alone."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, isclose, pi
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Scene, SensorKind
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import SECONDS
from mindrun.numbers.trigonometry import sine

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Reader, Readings


@dataclass(frozen=True, slots=True)
class Wave(SensorKind):
    """What goes by time alone: its reading at t/period without its whole part, t in seconds since the first tick."""

    period: Annotated[float, SECONDS]

    def at(self, turned: float) -> float:
        """The reading after a share of the period."""
        return turned

    def reader(self, scene: Scene) -> Reader:
        import numpy as np

        period = self.period / scene.tick

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            turned = number / period
            return np.float32(self.at(turned - floor(turned)))

        return read


@kind("sensor", "clock")
class Clock(Wave):
    """A saw tooth: from 0 to 1 in every period, then 0 again; t/period without its whole part."""

    still = 0.0
    remedy = "Give it a period of more than a tick"

    def constant(self, world: WorldFacts) -> float | None:
        return 0.0 if self.period == world.tick else None

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        for p in range(n):
            turned = s.tick[p] / sensor.period
            out[p] = F(turned - np.floor(turned))


@kind("sensor", "sine")
class Sine(Wave):
    """A wave: 0.5 + 0.5 sin(2πt/period)."""

    still = 0.5
    remedy = "Give it a period of more than two ticks"

    def constant(self, world: WorldFacts) -> float | None:
        halves = 2 * world.tick / self.period
        return 0.5 if halves > 0.5 and isclose(halves, round(halves)) else None

    def at(self, turned: float) -> float:
        return 0.5 + 0.5 * sine(2 * pi * turned)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        out = s.readings[sensor.start]
        for p in range(n):
            turns = s.tick[p] / sensor.period
            wave, _ = sine_cosine(2 * np.pi * (turns - np.floor(turns)))
            out[p] = F(0.5 + 0.5 * wave)
