"""The types that an argument of a kind can have: what a number means, which units it takes, what it may be."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from math import inf, pi
from typing import Annotated, Literal

Rate = Literal["", "added", "kept"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with a meaning. `units` maps a unit as written to the factor that gives the stored value.

    A `rate` is stored for each tick: so much is "added" in one, or is the share that is "kept" in one.
    """

    name: str
    units: Mapping[str, float]
    low: float = -inf
    high: float = inf
    whole: bool = False
    rate: Rate = ""

    def in_tick(self, in_second: float, tick_seconds: float) -> float:
        """A rate per second as a rate per tick: of what is kept, a power; the same bits on every machine."""
        if self.rate == "kept":
            return float(Decimal(in_second) ** Decimal(tick_seconds)) if in_second > 0 else 0.0
        return in_second * tick_seconds


@dataclass(frozen=True, slots=True)
class Reference:
    """The name of something declared elsewhere: a thing of the task, a sensor, a word of a fixed list."""

    noun: str
    words: tuple[str, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class Span:
    """`5` (first = last), `4 to 8` (drawn uniformly), or `3 to 1 by 0.1` (a schedule, one step each time it moves)."""

    first: float
    last: float
    by: float | None = None


Extent = float | tuple[float, float]  # `100`: both ways alike; `60 40`: along x and along y
Place = tuple[float, float]  # `30 -20`
Region = str | tuple[Place, ...]  # the name of a thing, or `-10 -10 to 10 10`: two corners; empty where none is said

UNSAID = Span(-1.0, -1.0)  # in place of lengths that nobody has given
LEAST_STEP = 1e-9  # of a schedule


def fits(meaning: Quantity | Reference, value: object) -> bool:
    """True if a stored value is allowed for its argument: `neutral` is a share, a wheel's side left or right."""
    match meaning, value:
        case Quantity(low=low, high=high), int() | float():
            return low <= value <= high
        case Reference(words=words), str():
            return not words or value in words
        case Quantity(low=low, high=high), Span(first, last, by) if value != UNSAID:
            is_one = first <= last if by is None else LEAST_STEP <= by <= high
            return is_one and low <= min(first, last) and max(first, last) <= high
        case _, tuple():
            return all(fits(meaning, each) for each in value)
    return True


# Every number has bounds, far beyond any robot and far from where arithmetic or Chipmunk would give up.
NUMBER = Quantity("a number", {"": 1.0}, low=-1e9, high=1e9)
LENGTH = Quantity("a length in world units", {"": 1.0}, low=0.0, high=1e5)
FARTHEST_UNITS = 1e9  # no limit to a distance: nothing is so far away
DISTANCE = replace(LENGTH, name="a distance in world units", high=FARTHEST_UNITS)
POSITIVE = Quantity("a number above zero", {"": 1.0}, low=1e-6, high=1e6)
COORDINATE = replace(LENGTH, name="a coordinate in world units", low=-1e5)
ANGLE = Quantity("an angle", {"deg": pi / 180}, low=-20 * pi, high=20 * pi)
SECONDS = Quantity("a time", {"s": 1.0}, low=1e-6, high=1e9)
TICK = Quantity("the length of a tick", {"s": 1.0}, low=1e-5, high=1000.0)
LENGTH_OF_UNIT = Quantity("how long a unit of the world is", {"cm": 0.01, "m": 1.0, "mm": 0.001}, low=1e-4, high=1000.0)
TICKS = Quantity("a number of ticks", {"ticks": 1.0}, low=0, high=1000, whole=True)
WINDOW = Quantity("a number of ticks", {"ticks": 1.0}, low=1, high=1000, whole=True)
GENERATIONS = Quantity("a number of generations", {"generations": 1.0}, low=1, high=10_000_000, whole=True)
RATIO = Quantity("a share between 0 and 1", {"": 1.0, "%": 0.01}, low=0.0, high=1.0)
RATE = Quantity("a share between 0 and 1 for each tick", {"": 1.0, "%": 0.01}, low=0.0, high=1.0, rate="added")
DECAY = Quantity("the share that is left after a tick", {"": 1.0, "%": 0.01}, low=0.0, high=1.0, rate="kept")
COUNT = Quantity("a whole number", {"": 1.0}, low=1, high=1000, whole=True)
INDEX = Quantity("a number of a slot", {"": 1.0}, low=0, high=1e6, whole=True)

THING = Reference("thing")
SENSOR = Reference("sensor")
SKILL = Reference("skill")
SERVO = Reference("servo")
EXPRESSION = Reference("expression")
FUNCTION = Reference("Python function")
SLOT = Reference("name of a part of an observation or an action")

# Types of arguments, as fields of many kinds have them.
Ratio = Annotated[float, RATIO]
ThingName = Annotated[str, THING]
Ticks = Annotated[int, TICKS]
Count = Annotated[int, COUNT]
Positive = Annotated[float, POSITIVE]
Lengths = Annotated[Span, LENGTH]
Places = Annotated[tuple[Place, ...], COORDINATE]
SensorName = Annotated[str, SENSOR]
ServoName = Annotated[str, SERVO]
PartName = Annotated[str, SLOT]
Indices = Annotated[tuple[int, ...], INDEX]
Length = Annotated[float, LENGTH]
Range = Annotated[Span, NUMBER]
Angles = Annotated[tuple[float, ...], ANGLE]
Number = Annotated[float, NUMBER]
Angle = Annotated[float, ANGLE]
