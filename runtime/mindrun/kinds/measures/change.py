"""The change of the wheels' commands."""

from dataclasses import replace
from math import inf
from typing import Annotated

from mindrun.kinds.measures.measure import MeasureKind, Row
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import RATIO, TICKS, Reference


@kind("measure", "change")
class CommandChange(MeasureKind):
    """Sum over the wheels of how much the command changed over the last `over` ticks, beyond a share of its travel."""

    of: Annotated[str, Reference("quantity", ("thrust",))]
    beyond: Annotated[float, RATIO] = 0.0
    over: Annotated[int, replace(TICKS, low=1.0)] = 10

    interval = (0.0, inf)

    @property
    def remembered(self) -> int:
        """The ticks of the argument `over`, at least one."""
        return max(1, self.over)

    def row(self) -> Row:
        """The share of a wheel's travel beyond which a change counts."""
        return {"beyond": self.beyond}
