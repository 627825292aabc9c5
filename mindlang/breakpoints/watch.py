"""Where breakpoints stop a run, found in its rows; they may be fed as they come, in parts of any size."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from operator import neg
from typing import Any, Protocol

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.engine.think import Hierarchy, hierarchy
from mindrun.kinds.events.event import EventKind
from mindrun.numbers.evaluation import OPERATORS
from mindrun.numbers.expression import Program, fold
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, Transmission
from mindlang.breakpoints.robot_events import RobotEvent
from mindlang.breakpoints.transmission import Transmissions
from mindlang.run.setup import RunSetup

Leaf = Callable[[str, Any], Any]
Measured = Mapping[Transmission, NDArray[np.float64]]


class Rows(Protocol):
    """Rows of a run, one a tick, such as those of a RecordedRun: what was read, thought, sent and had happened so far.

    `events` [rows, events] has how often each has happened since the beginning of the run.
    """

    @property
    def readings(self) -> NDArray[np.float32]:
        """[rows, width], as the skills read them."""
        ...

    @property
    def influence(self) -> NDArray[np.float32]:
        """[rows, skills]."""
        ...

    @property
    def commands(self) -> NDArray[np.float32]:
        """[rows, actuators]."""
        ...

    @property
    def events(self) -> NDArray[np.int64]:
        """[rows, events]; no columns where nobody notices any."""
        ...


@dataclass(frozen=True, slots=True)
class Part:
    """Some rows of a run."""

    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: NDArray[np.float32]
    events: NDArray[np.int64]


def part(rows: Rows, first: int, end: int) -> Part:
    """The rows from `first` up to `end`, counted from 0."""
    here = slice(first, end)
    return Part(rows.readings[here], rows.influence[here], rows.commands[here], rows.events[here])


@dataclass(frozen=True, slots=True)
class Stop:
    """A breakpoint is met in a tick, counted from 1; `values` are the readings and commands that its line names.

    Of an event that is how often it has happened.
    """

    tick: int
    breakpoint: Breakpoint
    values: tuple[tuple[str, float], ...]


class Watcher:
    """Where breakpoints stop a run, of whose rows it has been fed the first `ticks`."""

    def __init__(
        self,
        breakpoints: Sequence[Breakpoint],
        events: Sequence[EventKind | RobotEvent],
        mind: Hierarchy,
        actuators: int,
    ) -> None:
        self.ticks = 0
        self._breakpoints = breakpoints
        self._columns = {event: column for column, event in enumerate(events)}
        self._held = [False] * len(breakpoints)
        self._times = [0] * len(breakpoints)
        asked = chain.from_iterable(each.cause.transmissions for each in breakpoints if isinstance(each.cause, Holds))
        self._asked = tuple(dict.fromkeys(asked))
        self._transmissions = Transmissions(self._asked, mind, actuators)

    def feed(self, rows: Rows, begins: Iterable[int] = ()) -> list[Stop]:
        """All stops in the rows that follow those of before, in the order of their ticks and then of their lines.

        In the rows of `begins`, counted from 0 among these, the mind was begun anew.
        """
        found = self._transmissions.feed(rows.readings, rows.influence, begins)
        weights = dict(zip(self._asked, found, strict=True))
        stops = [stop for place in range(len(self._breakpoints)) for stop in self._stops(place, rows, weights)]
        self.ticks += len(rows.readings)
        return sorted(stops, key=lambda stop: stop.tick)

    def _stops(self, place: int, rows: Rows, weights: Measured) -> list[Stop]:
        each = self._breakpoints[place]
        match each.cause:
            case Reaches(tick):
                return [Stop(tick, each, ())] if self.ticks < tick <= self.ticks + len(rows.readings) else []
            case Happens() as cause:
                return self._happening(place, each, cause, rows)
        leaf = _leaf(rows, [weights[transmission] for transmission in each.cause.transmissions])
        return self._beginning(place, each, each.cause, leaf, len(rows.readings))

    def _happening(self, place: int, each: Breakpoint, cause: Happens, rows: Rows) -> list[Stop]:
        """Where an event happens, or where it happens for the time that is asked for."""
        times = rows.events[:, self._columns[cause.event]] if cause.event in self._columns else np.zeros(0, np.int64)
        before = np.concatenate([[self._times[place]], times])
        self._times[place] = int(before[-1])
        is_met = (before[:-1] < cause.times) & (times >= cause.times) if cause.times else times > before[:-1]
        return [
            Stop(self.ticks + 1 + int(row), each, (("times", float(times[row])),)) for row in np.flatnonzero(is_met)
        ]

    def _beginning(self, place: int, each: Breakpoint, cause: Holds, leaf: Leaf, rows: int) -> list[Stop]:
        """Where a condition holds, and did not hold in the tick before."""
        holds = over(cause.program, leaf, rows) > 0
        before = np.concatenate([[self._held[place]], holds])
        self._held[place] = bool(before[-1])
        columns = [(name, leaf(*operand)) for name, operand in cause.named]
        return [
            Stop(self.ticks + 1 + int(row), each, tuple((name, float(column[row])) for name, column in columns))
            for row in np.flatnonzero(holds & ~before[:-1])
        ]


def noticing(setup: RunSetup, breakpoints: Sequence[Breakpoint]) -> RunSetup:
    """The setup of the same run, whose task also notices the events of breakpoints that none of its lines is about."""
    asked = dict.fromkeys(each.cause.event for each in breakpoints if isinstance(each.cause, Happens))
    missing = [event for event in asked if isinstance(event, EventKind) and event not in setup.task.events]
    if not missing:
        return setup
    policy, task = setup.ready.policy, replace(setup.task, events=(*setup.task.events, *missing))
    tasks = tuple(task if each.name == task.name else each for each in policy.graph.tasks)
    noticing = replace(policy, graph=replace(policy.graph, tasks=tasks))
    return replace(setup, task=task, ready=replace(setup.ready, policy=noticing))


def watcher(breakpoints: Sequence[Breakpoint], setup: RunSetup) -> Watcher:
    """What watches a run of the setup for breakpoints; WeightsError or ProcedureError where its skills cannot think."""
    graph = setup.ready.policy.graph
    sources = procedure_sources(graph, setup.folder, setup.master)
    mind = hierarchy(setup.ready.policy, sources, setup.master)
    return Watcher(breakpoints, setup.task.events, mind, len(graph.actuators))


def over(program: Program, leaf: Leaf, rows: int) -> NDArray[np.float64]:
    """The value of an expression in each of so many rows, `leaf` giving those of its readings [rows]."""

    def combined(operator: str, left: Any, right: Any) -> Any:
        return OPERATORS[operator](left, right)

    with np.errstate(all="ignore"):
        return np.broadcast_to(np.float64(fold(program, leaf, neg, combined)), (rows,))


def _leaf(rows: Rows, measures: Sequence[NDArray[np.float64]]) -> Leaf:
    """What a number, a reading, a command or a measure is in each row, in float64 as the engine takes them."""

    def column(word: str, operand: Any) -> Any:
        match word:
            case "reading":
                return rows.readings[:, int(operand)].astype(np.float64)
            case "command":
                return rows.commands[:, int(operand)].astype(np.float64)
            case "measure":
                return measures[int(operand)]
        return np.float64(operand)

    return column
