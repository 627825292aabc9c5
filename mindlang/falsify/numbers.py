"""The numbers that a task draws for each run: what varies, when what fails is stuck, and what the task draws itself.

They are known as soon as a run begins. So a run whose numbers lie where they are wanted is found among many seeds of
which nothing but the beginning is computed, and it is a run of the task as it stands: its seed repeats it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mindrun.graph.graph import Graph, Task
from mindrun.graph.tasks import varied_kind
from mindrun.kinds.registry import varied_quantity
from mindrun.sim.rollout import Rollout
from numpy.typing import NDArray

from mindlang.run.setup import NO_GENOME

SHOWN_DIGITS = 3  # of a value that is told
BEGUN_LANES = 1024  # runs that are begun at once


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a run: the words before its value, the least and the greatest that it can be, the unit behind it.

    `factor` is what one of the unit is in the program's own, and of a whole number no value lies between.
    """

    name: str
    low: float
    high: float
    unit: str = ""
    factor: float = 1.0
    is_whole: bool = False

    def within(self, low: float, high: float) -> str:
        """The number between two values, in words: `friction 0.1 to 0.3`."""
        first, last = self.value(low), self.value(high)
        return f"{self.name} {first if first == last else f'{first} to {last}'} {self.unit}".rstrip()

    def value(self, number: float) -> str:
        """A value with three digits, without its unit."""
        return f"{float(f'{number / self.factor:.{SHOWN_DIGITS}g}'):g}"


def numbers_of(graph: Graph, task: Task) -> list[Number]:
    """All numbers of a task, in the order in which the lanes have them."""
    found = []
    for each in task.varies:
        quantity = varied_quantity(varied_kind(graph, task, each), each.argument)
        unit, factor = next(iter(quantity.units.items())) if quantity else ("", 1.0)
        name = f"{each.argument} of {each.of or 'body'}"
        found.append(Number(name, each.low, each.high, unit, factor, bool(quantity and quantity.whole)))
    found += [Number(f"{each.actuator} fails at", 0, task.ticks, "ticks", 1.0, True) for each in task.fails]
    found += [Number(each.name, *each.interval, is_whole=not each.is_range) for each in task.draws]
    return found


def drawn_at(rollout: Rollout, seeds: Sequence[int]) -> NDArray[np.float64]:
    """The numbers [runs, numbers] of the runs of these seeds, of which only the beginning is computed."""
    count = sum(map(len, (rollout.task.varies, rollout.task.fails, rollout.task.draws)))
    tile, found = rollout.tile(BEGUN_LANES), [np.empty((0, count))]
    for first in range(0, len(seeds), BEGUN_LANES):
        some = np.array(seeds[first : first + BEGUN_LANES], np.uint64)
        rollout.fill(tile, rollout.jobs(NO_GENOME, some))
        found.append(tile.state.world.numbers[:count, : len(some)].T.copy())
    return np.concatenate(found)
