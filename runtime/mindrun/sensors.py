"""Kinds of sensors. What each reads in a simulated world is in `sim/lanes/sense.py`; on a robot a driver reads it.

Every reading is a real number in 0..1. `range` and `dead_zone` are as for a range finder where a kind has them.
"""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import ANGLE, LENGTH, POSITIVE, RATIO, SECONDS, SENSOR, THING, TICKS
from mindrun.registry import kind


@dataclass(frozen=True, slots=True, kw_only=True)
class Physical:
    """What is not perfect about a sensor that measures something, and is so in training.

    It is read `every` so many ticks and says the same in between. `noise` is how far off a reading may be, `lost` the
    share of readings that fail: they read as if there were nothing (of a battery: as before). What a skill sees is
    `delay` ticks old.
    """

    noise: Annotated[float, RATIO] = 0.0
    lost: Annotated[float, RATIO] = 0.0
    every: Annotated[int, TICKS] = 1
    delay: Annotated[int, TICKS] = 0


@kind("sensor", "range_finder")
@dataclass(frozen=True, slots=True)
class RangeFinder(Physical):
    """Distance from the body's rim to the nearest obstacle, one reading per angle: 0 touching, 1 clear within `range`.

    Angles turn counterclockwise from straight ahead. A reading below `dead_zone` is 0.
    """

    at: Annotated[tuple[float, ...], ANGLE] = (0.0,)
    range: Annotated[float, POSITIVE] = 12.0
    dead_zone: Annotated[float, RATIO] = 0.005


@kind("sensor", "bearing")
@dataclass(frozen=True, slots=True)
class Bearing(Physical):
    """Direction of a thing: 0.5 straight ahead, less on the left, more on the right, the seam behind; 0.5 without it.

    0.5 − atan2(y, x)/2π in the body's frame. Within `dead_zone` of straight ahead it reads 0.5; with a `range`,
    a thing farther away than that reads 0.5 too.
    """

    of: Annotated[str, THING]
    range: Annotated[float, LENGTH] = 0.0
    dead_zone: Annotated[float, RATIO] = 0.0


@kind("sensor", "contact")
@dataclass(frozen=True, slots=True)
class Contact(Physical):
    """1 while the thing is in the claw's reach, else 0."""

    of: Annotated[str, THING]


@kind("sensor", "held")
@dataclass(frozen=True, slots=True)
class Held(Physical):
    """1 while the claw holds the thing, else 0."""

    of: Annotated[str, THING]


@kind("sensor", "inside")
@dataclass(frozen=True, slots=True)
class Inside(Physical):
    """1 while the robot's centre is inside the thing, else 0."""

    of: Annotated[str, THING]


@kind("sensor", "inertial")
@dataclass(frozen=True, slots=True)
class Inertial(Physical):
    """Whether the robot moves: its displacement over the last 20 ticks as a mean speed, 1 from `range` units/s on."""

    range: Annotated[float, POSITIVE] = 1.0
    dead_zone: Annotated[float, RATIO] = 0.0


@kind("sensor", "battery")
@dataclass(frozen=True, slots=True)
class Battery(Physical):
    """Charge of the battery: `start`s there, loses `drain` every tick, gains `charge` every tick inside a `power`."""

    start: Annotated[float, RATIO] = 0.4
    drain: Annotated[float, RATIO] = 0.00005
    charge: Annotated[float, RATIO] = 0.005


@kind("sensor", "derivative")
@dataclass(frozen=True, slots=True)
class Derivative:
    """Change of another sensor's readings: 0.5 none, 1 rising by `range` a second. A bearing turns the short way."""

    of: Annotated[str, SENSOR]
    range: Annotated[float, POSITIVE] = 1.0
    dead_zone: Annotated[float, RATIO] = 0.0


@kind("sensor", "sine")
@dataclass(frozen=True, slots=True)
class Sine:
    """A wave: 0.5 + 0.5 sin(2πt/period)."""

    period: Annotated[float, SECONDS]
