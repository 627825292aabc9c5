"""One reading of a wide sensor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Flaw, Row, Scene, SensorKind
from mindrun.numbers.quantity import COUNT, SENSOR

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "reading")
class Reading(SensorKind):
    """One reading of a sensor that has several; the first is 1."""

    reading: Annotated[int, COUNT]
    of: Annotated[str, SENSOR]

    circular = None

    def flaw(self, widths: Mapping[str, int]) -> Flaw | None:
        """A flaw where the source has not so many readings."""
        if self.reading <= (width := widths.get(self.of, 0)):
            return None
        has = f"{self.of} has {width} reading{'s' * (width != 1)}."
        return Flaw("no-such-reading", "reading", has, f"Write a number from 1 to {width}.")

    def reader(self, scene: Scene) -> Reader:
        """A slice of all readings: the one of the source with that number."""
        place = scene.starts[self.of] + self.reading - 1

        def read(number: int, now: Readings, before: Readings | None) -> Readings:
            return now[place : place + 1]

        return read

    def row(self, scene: Scene) -> Row:
        """The row of that reading, as `source`."""
        return {"source": scene.starts[self.of] + self.reading - 1}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Copy that reading of the source."""
        for p in range(n):
            s.readings[sensor.start, p] = s.readings[sensor.source, p]
