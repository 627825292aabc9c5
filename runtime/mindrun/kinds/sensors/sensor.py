"""The base classes of sensors: the rest of the program asks a kind for these, and knows none by name."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Set
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from mindrun.kinds.environment import OfEnvironment
from mindrun.kinds.registry import arguments, base, named_arguments
from mindrun.kinds.things.thing import AboutThing, WorldFacts
from mindrun.numbers.expression import Formula, named
from mindrun.numbers.quantity import ANGLE, EXPRESSION, SENSOR, SERVO, Ratio, Ticks

if TYPE_CHECKING:
    from mindrun.kinds.actuators.actuator import ActuatorKind
    from mindrun.numbers.arrays import Reader

Row = Mapping[str, float]  # columns of the lanes' table of sensors
TOLD = ("range", "dead_zone", "over", "period")  # arguments that are such columns
Shape = tuple[int, ...]  # of readings: () of a single one, (n,) of n side by side
Bounds = tuple[float, float]  # the least and the greatest


class Begin(Protocol):
    """The facts that are known about the beginning of a run."""

    def is_within(self, thing: str) -> bool | None: ...  # whether the robot is in a thing; None where that is drawn
    def first(self, name: str) -> Bounds: ...  # what a sensor or a memory reads in the first tick


class Flaw(NamedTuple):
    """An error in a sensor's arguments: a code, the field of the argument, a sentence, and what to do."""

    code: str
    field: str
    message: str
    hint: str


@dataclass(frozen=True, slots=True)
class Scene:
    """All that a sensor can depend on beside its own arguments.

    The length of a `tick` in seconds, where the readings of each sensor and memory stand, which are directions, where
    the influence of each skill stands (of the tick before, in the engine behind that one's readings), and the kinds.
    """

    tick: float
    places: Mapping[str, slice]
    directions: Set[str] = frozenset()
    skills: Mapping[str, int] = field(default_factory=dict)
    kinds: Mapping[str, Any] = field(default_factory=dict)  # of sensors and memories, by name

    @property
    def starts(self) -> Mapping[str, int]:
        """The row at which the readings of each sensor and memory begin."""
        return {name: place.start for name, place in self.places.items()}


@base("sensor")
class SensorKind(AboutThing, OfEnvironment):
    """A sensor of one reading that varies; a kind says what is different about it."""

    __slots__ = ()

    varying: tuple[str, ...] = ()  # the arguments that can differ from run to run
    circular: bool | None = False  # whether it reads a direction, which goes round: 1 is 0; None where its source does
    compares = False  # whether it compares its source with numbers
    looks = False  # whether its readings are how far it is along rays, 1 from `range` on
    scaled = False  # whether its values mean something by themselves, so that they need no calibration
    near: int | None = None  # the reading of what is near
    tells_servo = False  # whether it reads where its servo looks
    unit = ""  # of a driver that measures the same: m for a length, m/s for a speed
    is_given = False  # whether somebody has to read it: the engine does not compute it
    is_order = False  # whether it is what somebody says
    needs_driver = True  # whether on a robot it is not known without one
    can_be_reckoned = False  # whether it may be about a memory that is a place
    is_reckoned = False  # whether it is
    keeps_lost = False  # whether a reading that fails is the one before, and not `blank`
    remembered = 0  # how many numbers the lanes keep of each of its readings
    blank, rest = 0.0, 0.0  # what it reads where there is nothing to measure, and in its dead zone
    dead_zone = 0.0
    battery: Any = None  # the kind of sensor that says how the battery is that it reads
    still: float | None = None  # what it reads of a robot that stands, as it does when a run begins
    spots: tuple[tuple[float, float], ...] = ()  # of the floor that its readings look at, x ahead and y to the left
    sector = 0.0  # the angle, around each of its directions, in which it feels a touch; 0 where it feels none
    numbers: tuple[float, ...] = ()  # that its lane reads beside its row: `t.numbers`, from `sensor.number` on
    remedy = "Give it a dead_zone below 0.5"  # for one that is constant

    @property
    def shape(self) -> Shape | None:
        """The shape of its readings: one for each item of its list argument, else a single one; None: its source's."""
        lists = [getattr(self, each.field) for each in named_arguments(type(self)) if each.shape == "list"]
        return (len(lists[0]),) if lists else ()

    @property
    def source(self) -> str:
        """The sensor or memory from which it is computed, which its argument of that type says; empty for none."""
        return self.named(SENSOR)

    @property
    def sources(self) -> tuple[str, ...]:
        """All sensors and memories from which it is computed, each once."""
        return named(self.formula) or ((self.source,) if self.source else ())

    @property
    def formula(self) -> Formula:
        """The expression that it computes, in postfix order, with readings by their names; empty for none."""
        found: Any = self.named(EXPRESSION)
        return found or ()

    @property
    def servo(self) -> str:
        """The servo with which it turns, or whose direction it reads; empty for none."""
        return self.named(SERVO)

    def goes_round(self, directions: Collection[str]) -> bool:
        """True if its reading is a direction, given the names of other sensors whose readings are."""
        return self.source in directions if self.circular is None else self.circular

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        """The error in its arguments, or None.

        `widths` has the number of readings of each sensor and memory, `directions` are those that are directions.
        """
        return None

    def misfit(self, kinds: Mapping[str, SensorKind]) -> Flaw | None:
        """The error in what it is computed from, one of the sensors of these kinds, or None."""
        return None

    def sees(self, actuator: ActuatorKind) -> bool:
        """True if it reads, of a robot off the ground, whether an actuator turns."""
        return False

    @property
    def directions(self) -> tuple[float, ...]:
        """The angles at which it measures, one for each reading, counterclockwise from straight ahead."""
        lists = (each for each in arguments(type(self)) if each.shape == "list" and each.type is ANGLE)
        return next((getattr(self, each.field) for each in lists), ())

    @property
    def rays(self) -> tuple[float, ...]:
        """The angles along which it looks; none where it casts no rays."""
        return self.directions if self.looks else ()

    @property
    def reach(self) -> float:
        """The length of its rays in world units; 0 where it casts none."""
        return getattr(self, "range", 0.0) if self.looks else 0.0

    @property
    def ends(self) -> tuple[float, float]:
        """The values of the readings 0 and 1, of what has a `unit`: 0 to `range`, or ±range where 0.5 is nothing."""
        high = getattr(self, "range", 0.0) if self.unit else 0.0
        return (-high, high) if high and self.blank == 0.5 else (0.0, high)

    @property
    def taught(self) -> SensorKind:
        """The kind without what only a robot asks for."""
        return self

    def row(self, scene: Scene) -> Row:
        """The kind's own columns of the lanes' table: its source, its gain, and arguments that are TOLD."""
        plain = (each.field for each in arguments(type(self)) if each.shape == "one" and each.field in TOLD)
        told = {name: getattr(self, name) for name in plain}
        told |= {"period": told["period"] / scene.tick} if "period" in told else {}
        gain = self.gain(scene)
        return told | ({"source": scene.starts[self.source]} if self.source else {}) | ({"gain": gain} if gain else {})

    def gain(self, scene: Scene) -> float:
        """The factor of what is measured, or what is taken off it, where its lane function asks for one; else 0."""
        return 0.0

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Write its readings in n lanes of a simulated world: `s.readings[sensor.start, p]`.

        Compiled, in the terms of `numbers.arithmetic`, which it is given then: its file imports them for checkers of
        types alone, since whoever reads a mind has no numpy. `t` are the tables of the program, `s` is the state of
        the lanes (`sim/state.py` has every array), `clock` counts ticks, `sensor` is the row of the table.
        """

    def constant(self, world: WorldFacts) -> float | None:
        """The reading that never changes in a world, without its thing or in a dead zone that has all; else None."""
        if self.things and not any(thing in world.things for thing in self.things):
            return self.blank
        return self.rest if self.dead_zone > max(self.rest, 1 - self.rest) else None

    def first(self, begin: Begin) -> Bounds | None:
        """The least and greatest of its readings in the first tick of a run; None where nobody knows."""
        if self.circular is None:  # it reads what its source does
            return begin.first(self.source)
        return None if self.still is None else (self.still, self.still)

    def reader(self, scene: Scene) -> Reader | None:
        """A function of the tick's number, the readings now and those before, for the engine; None if it is measured.

        It may remember: it is called in every tick, from the first on, and made anew for another run.
        """
        return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Physical(SensorKind):
    """The base of sensors that measure something, with imperfections that training has, too.

    It is read `every` so many ticks and says the same in between. `noise` is how far off a reading may be, `lost` the
    share of readings that fail: they read as if there were nothing (of a battery: as before). What a skill sees is
    `delay` ticks old.
    """

    noise: Ratio = 0.0
    lost: Ratio = 0.0
    every: Ticks = 1
    delay: Ticks = 0

    is_given = True
    varying = ("noise", "lost", "delay")

    def first(self, begin: Begin) -> Bounds | None:
        """The bounds of its reading of a robot that stands, give or take the noise; None where nobody knows."""
        return None if self.still is None else self.around(self.still)

    def around(self, value: float) -> Bounds:
        """The least and the greatest reading where the true value is `value`, with noise and failures."""
        low, high = max(0.0, value - self.noise), min(1.0, value + self.noise)
        return (min(low, self.blank), max(high, self.blank)) if self.lost and not self.keeps_lost else (low, high)


class Ranging(Physical):
    """How far away something is: 0 touching, 1 from `range` on, or where nothing is."""

    __slots__ = ()

    scaled = True
    near = 0
    unit = "m"
    blank = 1.0


def directions(kinds: Mapping[str, SensorKind]) -> Set[str]:
    """The sensors whose reading is a direction: those that say so, and those that derive one from such a source."""
    onward: dict[str, list[str]] = {}
    for name, kind in kinds.items():
        for source in kind.sources:
            onward.setdefault(source, []).append(name)
    found = {name for name, kind in kinds.items() if kind.goes_round(())}
    waiting = [*found]
    while waiting:
        new = {name for name in onward.get(waiting.pop(), ()) if kinds[name].goes_round(found)} - found
        found |= new
        waiting += new
    return found
