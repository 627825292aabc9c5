"""A promise of a skill that is broken."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.computed import Computed
from mindrun.kinds.sensors.sensor import Begin, Bounds, Row, Scene, SensorKind
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.expression import Formula, evaluate, is_condition, named, placed
from mindrun.numbers.quantity import EXPRESSION, SKILL
from mindrun.numbers.stack_machine import evaluate as run_program

if TYPE_CHECKING:  # a lane is given these when it is compiled
    from collections.abc import Collection, Mapping

    import numpy as np

    from mindrun.kinds.sensors.sensor import Flaw
    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "broken")
class Broken(SensorKind):
    """1 where a skill acted in the tick before and what it `maintains` does not hold now, else 0.

    Where it acted and what it maintains depends on what is no number, it is no reading.
    """

    broken: Annotated[str, SKILL]
    maintains: Annotated[Formula, EXPRESSION] = ()

    @property
    def sources(self) -> tuple[str, ...]:
        return named(self.maintains)

    @property
    def formula(self) -> Formula:  # type: ignore[override]
        return self.maintains

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        is_one = self.maintains and is_condition(placed(self.maintains, dict.fromkeys(self.sources, 0)))
        return Computed(self.maintains if is_one else ()).flaw(widths, directions)

    def first(self, begin: Begin) -> Bounds:
        return 0.0, 0.0

    def constant(self, world: WorldFacts) -> float | None:
        return None

    def reader(self, scene: Scene) -> Reader:
        """The condition, of which nobody asks where the influence in the tick before was 0."""
        import numpy as np

        program, place = placed(self.maintains, scene.starts), scene.skills[self.broken]

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            if before is None or not before[len(now) + place] > 0:
                return np.float32(0)
            holds = evaluate(program, now)
            return np.float32(0 if holds > 0 else 1 if holds == 0 else np.nan)

        return read

    def row(self, scene: Scene) -> Row:
        return {"source": scene.skills[self.broken]}

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        """Run the condition over all lanes; the influence is still that of the tick before."""
        codes, out, acted = t.codes[sensor.code : sensor.code + sensor.length], s.readings[sensor.start], s.influence
        run_program(codes, s.readings, s.stack, s.readings, 0, s.stack, s.active, n, True)
        for p in range(n):
            holds = s.stack[0, p]
            v = ZERO if holds > 0.0 else ONE if holds == 0.0 else NAN
            out[p] = v if s.tick[p] > 0 and acted[sensor.source, p] > ZERO else ZERO
