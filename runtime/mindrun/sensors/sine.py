"""A wave, for what should happen again and again."""

from dataclasses import dataclass
from math import floor, isclose, pi
from typing import Annotated

import numpy as np

from mindrun.quantity import SECONDS
from mindrun.registry import kind
from mindrun.sensors.sensor import Reader, Readings, SensorKind, World
from mindrun.trigonometry import sine


@kind("sensor", "sine")
@dataclass(frozen=True, slots=True)
class Sine(SensorKind):
    """A wave: 0.5 + 0.5 sin(2πt/period)."""

    period: Annotated[float, SECONDS]

    remedy = "Give it a period of more than two ticks"

    def constant(self, world: World) -> float | None:
        """0.5 where every tick meets the wave there: it lasts one tick or two, or goes round in a part of one."""
        halves = 2 * world.tick / self.period
        return 0.5 if halves > 0.5 and isclose(halves, round(halves)) else None

    def reader(self, tick: float, source: slice, turns: bool) -> Reader:
        """0.5 + 0.5 sin(2πt/period), t in seconds since the first tick."""
        period = self.period / tick

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            turned = number / period
            return np.float32(0.5 + 0.5 * sine(2 * pi * (turned - floor(turned))))

        return read
