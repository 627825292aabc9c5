"""Changes of readings, influence and memory cells, tick by tick, with which a run goes on otherwise than it did.

And the engine that runs with such changes, bit for bit as `mindrun.sim.trace` makes them in the lanes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Literal

from numpy.typing import ArrayLike

from mindrun.engine.engine import Engine
from mindrun.engine.think import Thought, think
from mindrun.errors import MindError, nearest
from mindrun.graph.graph import Graph
from mindrun.numbers.arrays import Reader, Readings, Singles

What = Literal["reading", "influence", "memory"]
Changed = Mapping[What, Mapping[int, float]]  # the numbers that are others in one tick, by their places
UNCHANGED: Changed = {"reading": {}, "influence": {}, "memory": {}}


class ChangeError(MindError):
    """A change that cannot be made of this mind."""


@dataclass(frozen=True, slots=True)
class Change:
    """A number that is replaced from tick `first` to `last`, both counted from 1; to the end where `last` is None.

    `row` is the place of a reading or memory cell in the vector of readings, or that of a skill. It is `values[0]` in
    the first of the ticks, `values[1]` in the next, and stays at the last of them. Influence that counts over some
    actuators more than over others does so in the same ratios.
    """

    what: What
    row: int
    values: tuple[float, ...]
    first: int = 1
    last: int | None = None

    def holds(self, tick: int) -> bool:
        """True if the change is made in that tick."""
        return self.first <= tick and (self.last is None or tick <= self.last)

    def value(self, tick: int) -> float:
        """The number in a tick in which it is made."""
        return self.values[min(tick - self.first, len(self.values) - 1)]


def in_tick(changes: Sequence[Change], tick: int) -> Changed | None:
    """All that is changed in a tick, of two changes of one number the later one; None where nothing is."""
    made: dict[What, dict[int, float]] = {what: {} for what in UNCHANGED}
    for change in changes:
        if change.holds(tick):
            made[change.what][change.row] = change.value(tick)
    return made if any(made.values()) else None


def calm_ticks(changes: Sequence[Change], tick: int, most: int) -> int:
    """The ticks from this one on, in which nothing is changed, until the next change begins; `most` at most."""
    coming = (change.first - tick for change in changes if change.first > tick)
    return min([most, *coming])


def change_of(
    graph: Graph, what: What, name: str, values: Sequence[Sequence[float]], first: int = 1, last: int | None = None
) -> tuple[Change, ...]:
    """A sensor's readings, a skill's influence or a memory cell replaced; ChangeError where that cannot be.

    `values` [ticks][1] is one number for each tick from the first on, or [ticks][width] one for each of a sensor's
    readings; the last stay.
    """
    noun, start, width = _place(graph, what, name)
    if not 1 <= first <= (first if last is None else last):
        raise ChangeError(f"{name} cannot be changed from tick {first} to {last}", "the first tick of a run is 1")
    if any(len(row) not in {1, width} for row in values) or not values:
        number = "influence" if what == "influence" else "number" if what == "memory" else "reading"
        hint = f"write one number{f' for all, or {width}' * (width > 1)}: {name}=0.5"
        raise ChangeError(f"{noun} {name} has {width} {number}{'s' * (width > 1)}", hint)
    most = None if what == "influence" else 1.0
    for row in values:
        for value in row:
            if not (isfinite(value) and value >= 0 and (most is None or value <= most)):
                hint = "influence is a number from 0 on" if most is None else "it is a number from 0 to 1"
                raise ChangeError(f"{name} cannot be {value:g}", hint)
    return tuple(
        Change(what, start + k, tuple(float(row[k % len(row)]) for row in values), first, last) for k in range(width)
    )


def silenced(graph: Graph, skill: str, first: int = 1, last: int | None = None) -> tuple[Change, ...]:
    """A skill without any influence: it computes nothing and sends nothing, and what it remembers stays as it is."""
    return change_of(graph, "influence", skill, [[0.0]], first, last)


def _place(graph: Graph, what: What, name: str) -> tuple[str, int, int]:
    """The noun of that name, where its numbers begin, and how many they are; ChangeError where there is none."""
    match what:
        case "reading":
            noun, places = "sensor", {sensor.name: (sensor.start, sensor.width) for sensor in graph.sensors}
        case "influence":
            noun, places = "skill", {name: (number, 1) for name, number in graph.skill_numbers.items()}
        case "memory":
            noun, places = "memory", {memory.name: (memory.start, memory.kind.width) for memory in graph.memories}
    if name not in places:
        near = [one] if (one := nearest(name, places)) else sorted(places)
        raise ChangeError(f"there is no {noun} called {name}", f"there is {', '.join(near)}" if near else "")
    return noun, *places[name]


class ChangedEngine(Engine):
    """An engine whose `tick_with` makes changes, bit for bit as `mindrun.sim.trace` makes them in the lanes."""

    def reset(self) -> None:
        """Go back to the state before the first tick."""
        super().reset()
        self._made = UNCHANGED
        self._virtual = tuple((place, self._replacing(place, read)) for place, read in self._virtual)

    def tick_with(self, readings: ArrayLike, made: Changed | None) -> Singles:
        """Commands [actuators] for readings [graph.width] in a tick in which so much is changed."""
        self._made = made or UNCHANGED
        for row, value in self._made["memory"].items():
            self._kept[row - self._sensed] = value
        return self.tick(readings)

    def _filled(self, now: Singles) -> Singles:
        for row, value in self._made["reading"].items():
            now[row] = value
        return super()._filled(now)

    def _replacing(self, place: slice, read: Reader) -> Reader:
        """The reader of a virtual sensor that reads as `read` does, but for what is changed in the tick."""

        def replacing(number: int, now: Readings, before: Readings | None) -> Readings:
            now[place] = read(number, now, before)
            for row in range(place.start, place.stop):
                if row in self._made["reading"]:
                    now[row] = self._made["reading"][row]
            return now[place]

        return replacing

    def _thought(self) -> Thought:
        return think(self._hierarchy, self.readings, self._made["influence"])
