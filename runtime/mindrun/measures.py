"""Kinds of measures: numbers for rewards, taken every tick after the step by `sim/lanes/judge.py`."""

from dataclasses import dataclass, replace
from typing import Annotated

from mindrun.quantity import RATIO, THING, TICKS, Reference
from mindrun.registry import kind


@kind("measure", "progress")
@dataclass(frozen=True, slots=True)
class Progress:
    """Distance to the thing's centre closed in this tick, in world units; negative when moving away."""

    toward: Annotated[str, THING]


@kind("measure", "advance")
@dataclass(frozen=True, slots=True)
class Advance:
    """The progress toward the thing where it is positive, else 0."""

    toward: Annotated[str, THING]


@kind("measure", "retreat")
@dataclass(frozen=True, slots=True)
class Retreat:
    """The distance to the thing gained in this tick where it grew, else 0."""

    from_: Annotated[str, THING]


@kind("measure", "forward")
@dataclass(frozen=True, slots=True)
class Forward:
    """1 while the robot moves forward, else 0."""


@kind("measure", "change")
@dataclass(frozen=True, slots=True)
class Change:
    """Sum over the wheels of how much the command changed over the last `over` ticks, beyond a share of its travel."""

    of: Annotated[str, Reference("quantity", ("thrust",))]
    beyond: Annotated[float, RATIO] = 0.0
    over: Annotated[int, replace(TICKS, low=1.0)] = 10


Measure = Progress | Advance | Retreat | Forward | Change
