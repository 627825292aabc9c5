"""Numbers of a world that may differ from run to run: how each is drawn, or computed from one that is drawn.

Each is a row of `world.numbers` [row, lane], the same in every lane where nothing varies.
"""

from dataclasses import replace
from typing import Any, TypeVar

from mindrun.graph.draws import Draw
from mindrun.graph.graph import Graph, Task, Variation, Varying
from mindrun.graph.tasks import varied_kind
from mindrun.kinds.registry import varied_quantity
from mindrun.numbers.arrays import Array
from mindrun.sim import codes
from mindrun.sim.codes import Row, records

K = TypeVar("K")

SAME_IN_EVERY_RUN = -1  # in place of a row
Step = tuple[int, float]  # TIMES, OVER, INVERSE or DAMPING, and the number that it takes beside the one before


def computed(form: int, x: float, by: float) -> float:
    """The result of a step: 1/(1 + by·x), by/x, x/by or x·by; compiled, too."""
    if form == codes.DAMPING:
        return 1.0 / (1.0 + by * x)
    if form == codes.INVERSE:
        return by / x
    return x / by if form == codes.OVER else x * by


class Parameters:
    """The rows of a task, first of all those that are drawn: what varies, what fails, and what the task draws itself.

    Each in the order of the source.
    """

    def __init__(self, graph: Graph, task: Task) -> None:
        self._rows: list[Row] = []
        self._drawn: dict[tuple[str, str, str], tuple[int, Variation]] = {}
        for each in task.varies:
            quantity = varied_quantity(varied_kind(graph, task, each), each.argument)
            form = codes.DRAWN_WHOLE if quantity and quantity.whole else codes.DRAWN
            row = self._add(form, low=each.low, high=each.high)
            self._drawn[each.noun, each.of, each.argument] = row, each
        self._failing = {each.actuator: self._add(codes.FAILING, low=1.0 - each.rate) for each in task.fails}
        self.choices: list[float] = []
        self.given = [self._draw(each) for each in task.draws]  # the rows of what the task draws
        self._makings: list[Row] = []

    def made(self, code: int, length: int) -> int:
        """The row of what a program makes of the numbers that the task draws."""
        row = self._add(codes.MADE)
        self._makings.append({"row": row, "code": code, "length": length})
        return row

    def makings(self) -> Array:
        return records(self._makings, codes.MAKING)

    def _draw(self, draw: Draw) -> int:
        if draw.is_range:
            return self._add(codes.BETWEEN, low=draw.values[0], high=draw.values[1])
        self.choices += draw.values
        return self._add(codes.CHOSEN, of=len(self.choices) - len(draw.values), high=len(draw.values))

    def row(self, noun: Varying, of: str, argument: str, value: float, *steps: Step) -> int:
        """The row of an argument, or of what `steps` make of it; it is `value` where it does not vary."""
        if (noun, of, argument) not in self._drawn:
            for form, by in steps:
                value = computed(form, value, by)
            return self._add(codes.CONSTANT, low=value)
        row, _ = self._drawn[noun, of, argument]
        for form, by in steps:
            row = self._add(form, of=row, low=by)
        return row

    def failing(self, actuator: str) -> int:
        """The row of the tick from which an actuator is stuck; SAME_IN_EVERY_RUN where it never is."""
        return self._failing.get(actuator, SAME_IN_EVERY_RUN)

    def greatest(self, noun: Varying, of: str, kind: K) -> K:
        """A kind with the greatest values of its arguments that vary."""
        own = {each.argument: each.high for _, each in self._drawn.values() if (each.noun, each.of) == (noun, of)}
        whole: Any = kind
        return replace(whole, **{key: type(getattr(kind, key))(value) for key, value in own.items()}) if own else kind

    def table(self) -> Array:
        return records(self._rows, codes.PARAMETER)

    def _add(self, form: int, **numbers: float) -> int:
        self._rows.append({"form": form, **numbers})
        return len(self._rows) - 1
