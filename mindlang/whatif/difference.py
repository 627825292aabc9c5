"""Where two courses of the same begin to differ, and in what: the first tick, and the first of each kind of number."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import reading_names
from numpy.typing import NDArray

Array = NDArray[Any]
Columns = Mapping[str, Array]  # by name, a row for each tick


@dataclass(frozen=True, slots=True)
class Difference:
    """A number of a tick, counted from 1: what it `was`, and what it `is` with the changes."""

    tick: int
    what: str
    name: str
    was: float
    now: float

    def as_data(self) -> dict[str, Any]:
        """For `--json`; a number that is not finite is None."""
        return {k: None if isinstance(v, float) and not np.isfinite(v) else v for k, v in asdict(self).items()}


def first_differences(was: Mapping[str, Columns], now: Mapping[str, Columns]) -> list[Difference]:
    """The first tick of each kind of numbers, in the order of time: each number that differs in it.

    In one tick they stand in the order of the kinds, which is that of causes. Only names that both have are held
    against each other, in the ticks that both have.
    """
    found: list[Difference] = []
    for kind in was:
        names = [name for name in was[kind] if name in now.get(kind, {})]
        pairs = [(was[kind][name], now[kind][name]) for name in names]
        ticks = min((min(len(a), len(b)) for a, b in pairs), default=0)
        unlike = [_unlike(a[:ticks], b[:ticks]) for a, b in pairs]
        first = min((int(each.argmax()) for each in unlike if each.any()), default=None)
        if first is not None:
            found += [
                Difference(first + 1, kind, name, float(a[first]), float(b[first]))
                for name, (a, b), each in zip(names, pairs, unlike, strict=True)
                if each[first]
            ]
    return sorted(found, key=lambda difference: difference.tick)


def _unlike(a: Array, b: Array) -> NDArray[np.bool_]:
    different: NDArray[np.bool_] = ~((a == b) | (np.isnan(a) & np.isnan(b)))
    return different


def mind_columns(graph: Graph, readings: Array, influence: Array, commands: Array) -> dict[str, Columns]:
    """What a mind reads, thinks and sends in each tick, by name: not what nobody has measured in any."""
    named = {
        "reading": zip(reading_names(graph), readings.T, strict=True),
        "influence": zip((skill.name for skill in graph.skills), influence.T, strict=True),
        "command": zip((actuator.name for actuator in graph.actuators), commands.T, strict=True),
    }
    return {kind: {name: rows for name, rows in of if not np.isnan(rows).all()} for kind, of in named.items()}
