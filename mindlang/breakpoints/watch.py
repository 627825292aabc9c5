"""Finds where breakpoints stop a run or a robot's recording, in its rows, which may come in parts of any size."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Any

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.engine.think import Hierarchy, hierarchy
from mindrun.graph.bundle import Bundle
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.graph import Graph
from mindrun.graph.recording_header import About
from mindrun.kinds.events.event import EventKind
from mindrun.numbers.arrays import Leaf, evaluate_rows
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, RobotEvent, Transmission, robot_events
from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.run.edge_flow import EdgeFlow, EdgeFlows, Places, Singles, accumulated
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.recording import recorded_task
from mindlang.run.setup import RunSetup

Measured = Mapping[Transmission, NDArray[np.float64]]


@dataclass(frozen=True, slots=True)
class RowBlock:
    """Some rows of a run, one a tick: `readings` [rows, width] as the skills read them, `influence` [rows, skills] and
    `commands` [rows, actuators].

    `events` [rows, events] has how often each has happened since the beginning of the run; no columns where nobody
    notices any. `drawn` are the numbers that the task has drawn for the run, in their order.
    """

    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: NDArray[np.float32]
    events: NDArray[np.int64]
    drawn: Mapping[str, float] = field(default_factory=dict)


Rows = RowBlock | RecordedRun


@dataclass(frozen=True, slots=True)
class Stop:
    """A tick, counted from 1, in which a breakpoint is met; `values` are the readings and commands that its line names.

    Of an event that is how often it has happened.
    """

    tick: int
    breakpoint: Breakpoint
    values: tuple[tuple[str, float], ...]


class Watcher:
    """Finds where breakpoints stop a run, of whose rows it has been fed the first `ticks`."""

    def __init__(
        self, breakpoints: Sequence[Breakpoint], events: Sequence[EventKind | RobotEvent], graph: Graph, mind: Hierarchy
    ) -> None:
        self.ticks = 0
        self._breakpoints = breakpoints
        self._columns = {event: column for column, event in enumerate(events)}
        self._before: list[Any] = [0] * len(breakpoints)  # whether each held, or how often it had happened
        asked = chain.from_iterable(each.cause.transmissions for each in breakpoints if isinstance(each.cause, Holds))
        self._asked = tuple(dict.fromkeys(asked))
        self._transmissions = Transmissions(self._asked, graph, mind)

    def feed(self, rows: Rows, begins: Iterable[int] = ()) -> list[Stop]:
        """All stops in the rows that follow those of before, in the order of their ticks and then of their lines.

        In the rows of `begins`, counted from 0 among these, the mind was begun anew.
        """
        found = self._transmissions.feed(rows.readings, rows.influence, begins)
        weights = dict(zip(self._asked, found, strict=True))
        stops = [*chain.from_iterable(self._stops(place, rows, weights) for place in range(len(self._breakpoints)))]
        self.ticks += len(rows.readings)
        return sorted(stops, key=lambda stop: stop.tick)

    def _stops(self, place: int, rows: Rows, weights: Measured) -> Iterator[Stop]:
        each, count = self._breakpoints[place], len(rows.readings)
        match each.cause:
            case Reaches(tick):
                is_met, columns = np.arange(self.ticks + 1, self.ticks + count + 1) == tick, []
            case Happens(event, asked):
                if event not in self._columns:
                    return
                times = self._after(place, rows.events[:, self._columns[event]])
                is_met = (times[:-1] < asked) & (times[1:] >= asked) if asked else times[1:] > times[:-1]
                columns = [("times", times[1:])]
            case Holds(program, transmissions, named):
                leaf = _leaf(rows, [weights[transmission] for transmission in transmissions])
                holds = self._after(place, evaluate_rows(program, leaf, count) > 0)
                is_met = holds[1:] & ~holds[:-1]
                columns = [(name, leaf(*operand)) for name, operand in named]
        for row in np.flatnonzero(is_met):
            yield Stop(self.ticks + 1 + int(row), each, tuple((name, float(of[row])) for name, of in columns))

    def _after(self, place: int, rows: NDArray[Any]) -> NDArray[Any]:
        """The rows behind the last one fed before, which is 0 or False in the beginning."""
        found = np.concatenate([[self._before[place]], rows]).astype(rows.dtype)
        self._before[place] = found[-1]
        return found


def noticing(setup: RunSetup, breakpoints: Sequence[Breakpoint]) -> RunSetup:
    """The setup of the same run, with the events of breakpoints that its task does not notice added to the task."""
    causes = [each.cause.event for each in breakpoints if isinstance(each.cause, Happens)]
    asked = [of for event in causes if isinstance(event, EventKind) for of in (event, *event.single[1:])]
    missing = [event for event in dict.fromkeys(asked) if event not in setup.task.events]
    if not missing:
        return setup
    policy, task = setup.ready.policy, replace(setup.task, events=(*setup.task.events, *missing))
    tasks = tuple(task if each.name == task.name else each for each in policy.graph.tasks)
    return setup.with_policy(replace(policy, graph=replace(policy.graph, tasks=tasks)))


def watcher(breakpoints: Sequence[Breakpoint], setup: RunSetup) -> Watcher:
    """The watcher of a run of the setup; WeightsError or ProcedureError where its skills cannot think."""
    graph = setup.ready.policy.graph
    sources = procedure_sources(graph, setup.folder, setup.master)
    return Watcher(breakpoints, setup.task.events, graph, hierarchy(setup.ready.policy, sources, setup.master))


def _leaf(rows: Rows, measures: Sequence[NDArray[np.float64]]) -> Leaf:
    """A function for the value of a word of a condition in each row, float64 as in the engine."""
    drawn = [*rows.drawn.values()]

    def column(word: str, operand: Any) -> Any:
        match word:
            case "reading":
                return rows.readings[:, int(operand)].astype(np.float64)
            case "command":
                return rows.commands[:, int(operand)].astype(np.float64)
            case "measure":
                return measures[int(operand)]
            case "drawn":
                return np.full(len(rows.readings), drawn[int(operand)])
        return np.float64(operand)

    return column


class Transmissions:
    """The weights of some transmissions, row after row, computed by the engine's own functions.

    A function with a memory needs every row that was before.
    """

    def __init__(self, asked: Sequence[Transmission], graph: Graph, mind: Hierarchy) -> None:
        self._asked = asked
        self._begins: set[int] = set()
        self._flows = EdgeFlows(graph, mind, self._rows, self._begins) if asked else None
        self._fed = 0  # rows, before those of now
        self._now: tuple[Singles, Singles]  # those rows

    def feed(self, readings: Singles, influence: Singles, begins: Iterable[int] = ()) -> NDArray[np.float64]:
        """The weights [transmissions, rows] over the next readings [rows, width] and influence [rows, skills].

        Toward a skill that is the influence sent to it, a summand of Eq. 2; toward what is driven, the share of the
        influence that arrives there, a weight of the mean of Eq. 3. 0 where a skill transmits nothing. In the rows of
        `begins` the mind was begun anew.
        """
        self._now = readings, influence
        self._begins.update(self._fed + int(row) for row in begins)
        found = np.zeros((len(self._asked), len(readings)))
        end = self._fed + len(readings)
        if self._flows:
            for part, flow in self._flows.parts(np.arange(self._fed, end)):
                found[:, part] = [_weights(self._flows, flow, each) for each in self._asked]
            self._flows.go_on(end)
        self._fed = end
        return found

    def _rows(self, rows: Places) -> tuple[Singles, Singles]:
        readings, influence = self._now
        return readings[rows - self._fed], influence[rows - self._fed]


def _weights(flows: EdgeFlows, flow: EdgeFlow, asked: Transmission) -> NDArray[np.float64]:
    arriving = flows.links_to.get((asked.to, asked.target), [])
    own = [place for place in arriving if flows.links[place].source == asked.skill]
    sent = accumulated(flow.transmitted[:, own]).astype(np.float64)
    if asked.to == "skill":
        return sent
    with np.errstate(all="ignore"):
        return np.where(sent == 0, 0.0, sent / accumulated(flow.transmitted[:, arriving]).astype(np.float64))


def recording_subject(of: About, mind: Bundle) -> BreakpointSubject:
    return BreakpointSubject.of_recording(mind.graph, of.master, of.sensors, recorded_task(of, mind))


class RecordingWatcher:
    """Finds where breakpoints stop a recording, of which it has been fed some rows from the first on."""

    def __init__(self, breakpoints: Sequence[Breakpoint], of: About, mind: Bundle) -> None:
        """WeightsError or ProcedureError where a skill of the bundle cannot be made ready."""
        ready, task = hierarchy(mind.policy, mind.procedures, of.master), recorded_task(of, mind)
        events: tuple[EventKind | RobotEvent, ...] = (*robot_events(of.sensors), *(task.events if task else ()))
        self._watcher = Watcher(breakpoints, events, mind.graph, ready)
        self._drawn = drawn_numbers(task.draws, of.world.seed) if task and of.world else {}
        self._before = np.zeros((1, 1 + len(of.sensors)), bool)  # whether it had to stop, and the faults
        self._times = np.zeros((1, 2 + len(of.sensors)), np.int64)

    def feed(self, rows: NDArray[Any], readings: NDArray[np.float32]) -> list[Stop]:
        """The readings [rows, width] are as the skills had them."""
        facts = np.concatenate([self._before, np.column_stack([rows["stopped"], rows["faults"]]) != 0])
        begins = facts[1:] & ~facts[:-1]  # it stops, and the fault of each sensor
        begins = np.insert(begins.astype(np.int64), 1, begins[:, 1:].sum(axis=1), axis=1)  # and any fault
        happened = self._times + np.cumsum(begins, axis=0)
        self._before, self._times = facts[-1:], np.concatenate([self._times, happened])[-1:]
        if "world" in (rows.dtype.names or ()):
            happened = np.concatenate([happened, rows["world"]["events"].astype(np.int64)], axis=1)
        part = RowBlock(readings, rows["influence"], rows["commands"], happened, self._drawn)
        return self._watcher.feed(part, np.flatnonzero(rows["tick"] == 0))
