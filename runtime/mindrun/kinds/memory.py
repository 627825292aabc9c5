"""Kinds of memory: driven like an actuator, read like a sensor on the next tick."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import base, kind, names
from mindrun.kinds.sensors.sensor import Flaw, Row, Scene
from mindrun.numbers.quantity import DECAY, Positive, Ratio, SensorName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Keeper, Singles

UNDRIVEN_COMMAND = -1.0  # where no skill has influence
COUNTED_ABOVE, CLEARED_BELOW = 0.5, 0.25  # of what drives a counter


@base("memory")
class MemoryKind:
    """Numbers from 0 to 1 that a mind keeps from tick to tick; a kind says how they change."""

    __slots__ = ()

    width = 1  # how many readings it has: the first of what it keeps
    kept = 1  # how many numbers it keeps
    start = 0.0  # each of them when a run begins
    mixes = False  # whether what it keeps is a mean of several commands
    changes_alone = False  # whether it becomes another where nobody drives it
    is_place = False  # whether a bearing and a distance can be about it
    is_fixed = False  # whether no command changes it

    @property
    def sources(self) -> tuple[str, ...]:
        """The sensors from which it changes by itself."""
        return ()

    def flaw(self, kinds: Mapping[str, Any]) -> Flaw | None:
        """The error in its arguments, given the kinds of the sensors by name, or None."""
        return None

    def row(self, scene: Scene) -> Row:
        """The kind's own columns of the lanes' table."""
        return {}

    def keeper(self, scene: Scene) -> Keeper:
        """A function of what was kept [kept], the command and the readings of a tick: what is kept now, for the engine.

        The command is UNDRIVEN_COMMAND where there is none. The function remembers nothing itself.
        """
        raise NotImplementedError

    @staticmethod
    def lane(t: Any, s: Any, memory: Any, n: int) -> None:
        """Change what is kept in n lanes: `s.readings[memory.row, p]`, from that row on, by the command `s.sent[p]`.

        Compiled, in the terms of `numbers.arithmetic`, as that of a sensor; it is the last of a tick, so that readings
        are still those which the skills have read.
        """


@kind("memory", "cell")
class Cell(MemoryKind):
    """One number: decay·cell + (1 − decay)·command where a skill drives it, decay·cell where none has influence."""

    decay: Annotated[float, DECAY]
    start: Ratio = 0.0

    @property
    def mixes(self) -> bool:  # type: ignore[override]
        return self.decay > 0

    @property
    def changes_alone(self) -> bool:  # type: ignore[override]
        return self.start > 0 and self.decay < 1

    @property
    def is_fixed(self) -> bool:  # type: ignore[override]
        return self.decay == 1

    def row(self, scene: Scene) -> Row:
        return {"decay": self.decay, "rest": 1.0 - self.decay}

    def keeper(self, scene: Scene) -> Keeper:
        import numpy as np

        decay, rest = np.float32(self.decay), np.float32(1 - self.decay)

        def keep(kept: Singles, command: np.float32, readings: Singles) -> Singles:
            faded = decay * kept
            return faded + rest * command if command >= 0 else faded

        return keep

    @staticmethod
    def lane(t: Any, s: Any, memory: Any, n: int) -> None:
        cell, decay, rest = s.readings[memory.row], memory.decay, memory.rest
        for p in range(n):
            kept = decay * cell[p]
            cell[p] = kept + rest * s.sent[p] if s.sent[p] >= ZERO else kept


@kind("memory", "register")
class Register(MemoryKind):
    """One number that holds: the command where a skill drives it; as it was where none has influence."""

    start: Ratio = 0.0

    def keeper(self, scene: Scene) -> Keeper:
        import numpy as np

        def keep(kept: Singles, command: np.float32, readings: Singles) -> Singles:
            return np.full_like(kept, command) if command >= 0 else kept

        return keep

    @staticmethod
    def lane(t: Any, s: Any, memory: Any, n: int) -> None:
        number = s.readings[memory.row]
        for p in range(n):
            number[p] = s.sent[p] if s.sent[p] >= ZERO else number[p]


@kind("memory", "counter")
class Counter(MemoryKind):
    """A count of how often it was driven: `step` more each time that the command rises above 0.5, up to 1.

    A command counts again once a tick had none above 0.5. One below 0.25 sets it to 0; one between them, and no
    command, leave it as it is.
    """

    step: Ratio

    kept = 2  # the count, and 1 while the command is above 0.5

    def row(self, scene: Scene) -> Row:
        return {"rest": self.step}

    def keeper(self, scene: Scene) -> Keeper:
        import numpy as np

        step = np.float32(self.step)

        def keep(kept: Singles, command: np.float32, readings: Singles) -> Singles:
            rises = command > COUNTED_ABOVE
            count = kept[0] + step if rises and kept[1] == 0 else kept[0]
            count = np.float32(0) if 0 <= command < CLEARED_BELOW else min(count, np.float32(1))
            return np.array([count, rises], np.float32)

        return keep

    @staticmethod
    def lane(t: Any, s: Any, memory: Any, n: int) -> None:
        count, high = s.readings[memory.row], s.readings[memory.row + 1]
        for p in range(n):
            rises = s.sent[p] > F(COUNTED_ABOVE)
            v = count[p] + memory.rest if rises and high[p] == ZERO else count[p]
            count[p] = ZERO if s.sent[p] >= ZERO and s.sent[p] < F(CLEARED_BELOW) else clamp(v)
            high[p] = ONE if rises else ZERO


SENSED = {"left": "odometer", "right": "odometer", "compass": "compass"}  # by what it is reckoned: the kind of each


@kind("memory", "place")
class Place(MemoryKind):
    """A place by dead reckoning: how far it is to the east and to the north of the robot, 0.5 none, 1 `range` or more.

    Where the command is above 0.5 it is where the robot is as the tick begins; when a run begins, too. In each tick it
    moves back by what both odometers say of the robot's way, along what the compass says, and by nothing where one of
    them failed. A `bearing` and a `distance` can be of it.
    """

    left: SensorName
    right: SensorName
    compass: SensorName
    range: Positive = 100.0

    width = kept = 2
    start = 0.5
    changes_alone = is_place = True

    @property
    def sources(self) -> tuple[str, ...]:
        return self.left, self.right, self.compass

    def flaw(self, kinds: Mapping[str, Any]) -> Flaw | None:
        for field, wanted in SENSED.items():
            name = getattr(self, field)
            if name in kinds and names()[type(kinds[name])] != wanted:
                message = f"A place is reckoned by two odometers and a compass, and {name} is no {wanted}."
                return Flaw("no-dead-reckoning", field, message, f"Name a sensor that is {wanted}.")
        return None

    def ways(self, scene: Scene) -> tuple[float, float]:
        """The way in a tick, in widths of 2·range, of each odometer that reads 1 more than nothing."""
        left, right = (scene.kinds[name].range * scene.tick / (2 * self.range) for name in (self.left, self.right))
        return left, right

    def row(self, scene: Scene) -> Row:
        left, right = self.ways(scene)
        starts = {name: scene.starts[getattr(self, name)] for name in SENSED}
        return {**starts, "left_way": left, "right_way": right}

    def keeper(self, scene: Scene) -> Keeper:
        import numpy as np

        from mindrun.numbers.arithmetic import sine_cosine, stepped

        left_way, right_way = self.ways(scene)
        left, right, north = (scene.starts[name] for name in self.sources)

        def keep(kept: Singles, command: np.float32, readings: Singles) -> Singles:
            of_left, of_right, facing = (np.float64(readings[row]) for row in (left, right, north))
            way = (of_left - 0.5) * left_way + (of_right - 0.5) * right_way
            sine, cosine = sine_cosine(2.0 * np.pi * (facing - 0.25))
            east, north_ = (np.float32(0.5), np.float32(0.5)) if command > COUNTED_ABOVE else kept
            return np.array([stepped(east, way * cosine), stepped(north_, way * sine)], np.float32)

        return keep

    @staticmethod
    def lane(t: Any, s: Any, memory: Any, n: int) -> None:
        east, north = s.readings[memory.row], s.readings[memory.row + 1]
        left, right, facing = s.readings[memory.left], s.readings[memory.right], s.readings[memory.compass]
        for p in range(n):
            way = (np.float64(left[p]) - 0.5) * memory.left_way + (np.float64(right[p]) - 0.5) * memory.right_way
            sine, cosine = sine_cosine(2.0 * np.pi * (np.float64(facing[p]) - 0.25))
            is_here = s.sent[p] > F(COUNTED_ABOVE)
            east[p] = stepped(HALF if is_here else east[p], way * cosine)
            north[p] = stepped(HALF if is_here else north[p], way * sine)
