"""Sensors that are computed of one other sensor."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import inf, pi, remainder
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Flaw, Row, Scene, SensorKind
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.quantity import WINDOW, Angle, Count, Positive, Ratio, SensorName

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Doubles, Reader, Readings


@kind("sensor", "derivative")
class Derivative(SensorKind):
    """Change of another sensor's readings: 0.5 none, 1 rising by `range` a second. A direction turns the short way."""

    of: SensorName
    range: Positive = 1.0
    dead_zone: Ratio = 0.0

    shape = None
    remembered = 1
    rest = still = 0.5

    @property
    def remedy(self) -> str:  # type: ignore[override]
        if self.dead_zone > 0.5:
            return SensorKind.remedy
        return f"Derive it from another sensor than {self.of}, which never changes"

    def constant(self, world: WorldFacts) -> float | None:
        return 0.5 if world.is_constant(self.of) else SensorKind.constant(self, world)

    def reader(self, scene: Scene) -> Reader:
        """0.5 + change · gain; 0.5 in the first tick, NaN where the source is not finite now or was not before."""
        import numpy as np

        from mindrun.numbers.arithmetic import HALF, NAN, ONE, short_way

        gain, dead_zone = np.float32(0.5 / (scene.tick * self.range)), np.float32(self.dead_zone)
        source, turns = scene.places[self.of], self.of in scene.directions

        def read(number: int, now: Readings, before: Readings | None) -> Readings | np.float32:
            if before is None:
                return HALF
            change = now[source] - before[source]
            is_finite = np.isfinite(now[source]) & np.isfinite(before[source])
            if turns:
                change = short_way(change)
            value = np.fmin(np.fmax(HALF + change * gain, np.float32(0.0)), ONE)
            value = np.where(np.abs(value - HALF) < dead_zone, HALF, value)
            return np.where(is_finite, value, NAN)

        return read

    def gain(self, scene: Scene) -> float:
        return 0.5 / (scene.tick * self.range)

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for k in range(sensor.width):
            out, now, before = s.readings[sensor.start + k], s.readings[sensor.source + k], s.before[sensor.before + k]
            for p in range(n):
                d = now[p] - before[p]
                d = short_way(d) if sensor.turns else d
                v = clamp(HALF + d * sensor.gain)
                v = HALF if abs(v - HALF) < sensor.dead_zone else v
                v = v if finite(d) else NAN  # of what is no number
                out[p] = v if s.tick[p] > 0 else HALF
            for p in range(n):
                before[p] = now[p]


@kind("sensor", "average")
class Average(SensorKind):
    """The mean of another sensor's readings over the last ticks; in the first ones, over as many as there were.

    Of a direction it is one: the last reading, turned by the mean of the short ways from it to each. Of 0.98 and 0.01
    that is 0.995; as numbers it would be 0.495, the other way.
    """

    of: SensorName
    over: Annotated[int, WINDOW]

    circular = shape = None

    @property
    def remembered(self) -> int:  # type: ignore[override]
        return self.over

    def reader(self, scene: Scene) -> Reader:
        """The mean in float64 of a ring of the last readings, summed in the order in which they lie there."""
        import numpy as np

        from mindrun.numbers.arithmetic import short_way

        source, turns = scene.places[self.of], self.of in scene.directions
        ring: list[Doubles] = []

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            last = now[source].astype(np.float64)
            ring[number % self.over : number % self.over + 1] = [last]
            total = np.zeros(source.stop - source.start)
            for readings in ring:
                total = total + (short_way(readings - last) if turns else readings)
            mean = total / len(ring)
            if turns:
                mean = last + mean
                mean = np.where(mean < 0, mean + 1, np.where(mean > 1, mean - 1, mean))
            return mean.astype(np.float32)

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Put each reading into its ring, and average the ring in float64, in the order of `reader`."""
        total = s.stack[0]
        for k in range(sensor.width):
            first = sensor.before + k * sensor.over
            out, now = s.readings[sensor.start + k], s.readings[sensor.source + k]
            for p in range(n):
                s.before[first + s.tick[p] % sensor.over, p] = now[p]
                total[p] = 0.0
            for i in range(sensor.over):
                for p in range(n):
                    v = np.float64(s.before[first + i, p])
                    v = short_way(v - now[p]) if sensor.turns else v
                    total[p] += v if i <= s.tick[p] else 0.0
            for p in range(n):
                mean = total[p] / min(s.tick[p] + 1, sensor.over)
                out[p] = F(wrapped(now[p] + mean) if sensor.turns else mean)


@kind("sensor", "turned")
class Turned(SensorKind):
    """A direction, turned to the left `by` an angle, round the circle: by 180 deg it is the way away from there.

    Of a direction that is not known, which reads 0.5, it is turned all the same.
    """

    of: SensorName
    by: Angle

    circular = shape = None

    def gain(self, scene: Scene) -> float:
        """The angle as a share of a whole turn."""
        return self.by / (2 * pi)

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.of in directions or self.of not in widths:
            return None
        hint = "Turn a bearing or a compass; to add to a number, write computed at."
        return Flaw("no-direction", "of", f"{self.of} is not a direction, which could be turned.", hint)

    def first(self, begin: Begin) -> Bounds | None:
        """None: what is known of the source is turned, too."""
        return None

    def reader(self, scene: Scene) -> Reader:
        import numpy as np

        source, share = scene.places[self.of], np.float64(np.float32(self.gain(scene)))

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            value = now[source].astype(np.float64) - share
            return np.where((value < 0) | (value > 1), value - np.floor(value), value).astype(np.float32)

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for k in range(sensor.width):
            out, now = s.readings[sensor.start + k], s.readings[sensor.source + k]
            for p in range(n):
                v = np.float64(now[p]) - np.float64(sensor.gain)
                out[p] = F(v - np.floor(v) if v < 0.0 or v > 1.0 else v)


@kind("sensor", "mirrored")
class Mirrored(SensorKind):
    """Another sensor, as a robot in a mirror has it: with left and right exchanged.

    Of a direction it is 1 minus that. Of rays, switches or eyes on the floor it has the readings in opposite order, and
    they have to stand alike on both sides: the first as far to one as the last to the other.
    """

    of: SensorName

    circular = shape = None
    first = Turned.first

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.of in directions or widths.get(self.of, 2) > 1:
            return None
        hint = f"If it reads less on the left and more on the right, write computed at 1 - {self.of}."
        return Flaw("no-mirror", "of", f"{self.of} has one reading, and is not a direction.", hint)

    def misfit(self, kinds: Mapping[str, SensorKind]) -> Flaw | None:
        measured = kinds.get(self.of)
        for _ in kinds:  # behind an average, a latch … of it
            measured = kinds.get(measured.source) if measured and measured.shape is None else measured
        if measured is None or not measured.shape:
            return None
        turn, sides = 2 * pi, measured.directions
        if not sides:
            turn, sides = inf, tuple(left for _, left in measured.spots)
        if sides and all(abs(remainder(a + b, turn)) < 1e-9 for a, b in zip(sides, reversed(sides), strict=True)):
            return None
        hint = "Mirror a sensor that measures at angles or places as these: at -60 -20 20 60 deg."
        return Flaw("no-mirror", "of", f"The readings of {self.of} do not stand alike on both sides.", hint)

    def reader(self, scene: Scene) -> Reader:
        import numpy as np

        source, turns = scene.places[self.of], self.of in scene.directions
        return lambda number, now, before: np.float32(1) - now[source] if turns else now[source][::-1]

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for k in range(sensor.width):
            out, now = s.readings[sensor.start + k], s.readings[sensor.source + sensor.width - 1 - k]
            for p in range(n):
                out[p] = ONE - now[p] if sensor.turns else now[p]


@kind("sensor", "latch")
class Latch(SensorKind):
    """1 from when another sensor reads less than `below` until it reads more than `above`, else 0: hysteresis.

    It begins with 0, or with 1 where the first reading is below. A reading that failed leaves it as it is, and is none
    of its own.
    """

    of: SensorName
    below: Ratio
    above: Ratio

    compares = True
    shape = None
    remembered = 1

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.below <= self.above:
            return None
        hint = "Write the smaller one after below: latch of battery below 20% above 80%."
        return Flaw("latch-backwards", "above", "This latch lets go before it closes.", hint)

    def first(self, begin: Begin) -> Bounds:
        low, high = begin.first(self.of)
        return 0.0 if high >= self.below else 1.0, 1.0 if low < self.below else 0.0

    def reader(self, scene: Scene) -> Reader:
        import numpy as np

        source, below, above = scene.places[self.of], np.float32(self.below), np.float32(self.above)
        held = np.zeros(source.stop - source.start, np.float32)

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            found = now[source]
            held[found < below] = 1
            held[found > above] = 0
            return np.where(np.isfinite(found), held, np.float32(np.nan))

        return read

    def row(self, scene: Scene) -> Row:
        return {**SensorKind.row(self, scene), "low": self.below, "high": self.above}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for k in range(sensor.width):
            out, now, held = s.readings[sensor.start + k], s.readings[sensor.source + k], s.before[sensor.before + k]
            for p in range(n):
                was = held[p] if s.tick[p] > 0 else ZERO
                was = ONE if now[p] < sensor.low else was
                held[p] = ZERO if now[p] > sensor.high else was
                out[p] = held[p] if finite(now[p]) else NAN


@kind("sensor", "reading")
class Reading(SensorKind):
    """One reading of a sensor that has several; the first is 1."""

    reading: Count
    of: SensorName

    circular = None

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        if self.reading <= (width := widths.get(self.of, 0)):
            return None
        has = f"{self.of} has {width} reading{'s' * (width != 1)}."
        return Flaw("no-such-reading", "reading", has, f"Write a number from 1 to {width}.")

    def reader(self, scene: Scene) -> Reader:
        place = scene.starts[self.of] + self.reading - 1
        return lambda number, now, before: now[place : place + 1]

    def row(self, scene: Scene) -> Row:
        return {"source": scene.starts[self.of] + self.reading - 1}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        for p in range(n):
            s.readings[sensor.start, p] = s.readings[sensor.source, p]
