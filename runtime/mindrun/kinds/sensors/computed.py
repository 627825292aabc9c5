"""An expression over other readings, and a promise of a skill, which is one, that is broken."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import isfinite
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.registry import kind
from mindrun.kinds.sensors.sensor import Begin, Bounds, Flaw, Row, Scene, SensorKind
from mindrun.kinds.things.thing import WorldFacts
from mindrun.numbers.expression import Formula, evaluate, fold, is_condition, is_valid_program, placed, single
from mindrun.numbers.quantity import EXPRESSION, SKILL
from mindrun.numbers.stack_machine import evaluate as run_program

if TYPE_CHECKING:  # a lane is given these when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Reader, Readings


@kind("sensor", "computed")
class Computed(SensorKind):
    """The value of an expression over sensors and memories of one reading, clamped to 0..1. 0/0 is no reading.

    With `when` it is that where the condition holds, and what stands after `otherwise` where not; no reading where
    the condition compares what is not a number. A direction more or less numbers is one: it goes round, and 1.1 is 0.1.
    """

    at: Annotated[Formula, EXPRESSION]

    remedy = "Let it depend on a reading, or write the number where it is read"

    def goes_round(self, directions: Collection[str]) -> bool:
        """True if it is one direction, taken once, more or less numbers, or one of two such."""

        def leaf(word: str, operand: Any) -> int | None:
            return 0 if word == "number" else 1 if operand in directions else None

        def combined(symbol: str, left: int | None, right: int | None) -> int | None:
            if symbol == "when":
                return left
            if left is None or right is None:
                return None
            if symbol == "otherwise":
                return left if abs(left) == abs(right) else None
            if symbol in "+-":
                return left - right if symbol == "-" else left + right
            return 0 if left == right == 0 else None

        if not is_valid_program(self.at):  # which its flaw says
            return False
        return fold(self.at, leaf, lambda count: None if count is None else -count, combined) in (1, -1)

    def flaw(self, widths: Mapping[str, int], directions: Collection[str]) -> Flaw | None:
        starts = dict.fromkeys(self.sources, 0)
        if not (is_valid_program(placed(self.at, starts)) and all(widths.get(name) == 1 for name in self.sources)):
            return Flaw("wide-reading", "at", "It has an expression that cannot be computed.", "Read single readings.")
        return None

    def constant(self, world: WorldFacts) -> float | None:
        if self.sources:
            return None
        value = single(evaluate(placed(self.at, {})))
        return min(max(0.0, value), 1.0) if isfinite(value) else None

    def reader(self, scene: Scene) -> Reader:
        """The expression as a float32, clamped to 0..1, a direction without whole turns; NaN if it is not finite."""
        import numpy as np

        from mindrun.numbers.arithmetic import NAN, clamp

        program, turns = placed(self.at, scene.starts), self.goes_round(scene.directions)

        def read(number: int, now: Readings, before: Readings | None) -> np.float32:
            value = np.float32(evaluate(program, now))
            if turns and not 0 <= value <= 1:
                value = value - np.floor(value)
            return clamp(value) if isfinite(value) else NAN

        return read

    @staticmethod
    def lane(t: Any, s: Any, n: int, clock: int, sensor: Any) -> None:
        codes, out = t.codes[sensor.code : sensor.code + sensor.length], s.readings[sensor.start]
        run_program(codes, s.readings, s.stack, s.readings, 0, s.stack, s.active, n, True)
        for p in range(n):
            v = F(s.stack[0, p])
            v = v - np.floor(v) if sensor.turns and (v < ZERO or v > ONE) else v
            out[p] = clamp(v) if finite(v) else NAN


@kind("sensor", "broken")
class Broken(SensorKind):
    """1 where a skill acted in the tick before and what it `maintains` does not hold now, else 0.

    Where it acted and what it maintains depends on what is no number, it is no reading.
    """

    broken: Annotated[str, SKILL]
    maintains: Annotated[Formula, EXPRESSION] = ()

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
