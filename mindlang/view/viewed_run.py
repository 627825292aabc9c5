"""A simulated run that is seen while it is made, and the changes with which a viewer forks it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, get_args

import numpy as np
from mindrun.engine.changes import Change, What
from mindrun.engine.engine import procedure_sources
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import reading_names
from mindrun.graph.recording_header import About
from mindrun.sim.changed_ticks import STAGES
from mindrun.sim.rollout import Rollout
from mindrun.sim.task_rows import things_of
from mindrun.sim.trace import Ticks, Trace, trace
from mindrun.sim.warmup import is_there
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.watch import Part, Stop, Watcher, watcher
from mindlang.run import outcome
from mindlang.run.run_recording import recorded_rows, world_of
from mindlang.run.setup import RunSetup
from mindlang.view import messages
from mindlang.view.about import HierarchyData, Texts, WorldEvents, run_data
from mindlang.view.messages import RefusedError
from mindlang.view.rows import FLOW, Chunk, Columns, beginning, blocks, world_columns
from mindlang.view.texts import shown, stop_texts
from mindlang.view.viewed import Fork, SeenMind, Viewed, drawing_of

GROUPS: dict[What, str] = {"reading": "readings", "influence": "influence", "memory": "readings"}
COMPILING = "compiling what a changed run takes, once: about a minute…"


@dataclass(frozen=True, slots=True)
class ViewedRun:
    """A run to be seen: `texts` are what its edges say, `breakpoints` are of a setup that notices their events."""

    setup: RunSetup
    rollout: Rollout
    seed: int
    texts: Texts
    breakpoints: Sequence[Breakpoint] = ()
    changes: tuple[Change, ...] = ()

    def begun(self) -> Viewed:
        """The run that the rollout makes of the seed, with the changes."""
        setup, graph = self.setup, self.setup.ready.policy.graph
        mind = SeenMind.of(setup.ready.policy, procedure_sources(graph, setup.folder, setup.master), setup.master)
        columns = run_columns(setup, mind.edges)
        run = trace(self.rollout, self.seed, changes=self.changes)
        watching = watcher(self.breakpoints, setup) if self.breakpoints else None
        chunks = run_chunks(setup, run, self.seed, columns, watching)
        drawing = drawing_of(graph, setup.task, setup.folder, self.seed)
        about = {**self._about(run, mind, columns), "drawn": drawing is not None}
        return Viewed(about, columns, chunks, mind, self._forked, _compilation, drawing=drawing)

    def _forked(self, asked: messages.Change) -> Fork:
        setup, graph = self.setup, self.setup.ready.policy.graph
        columns = run_columns(setup, 0)
        change = replacement(graph, setup.task, columns, asked)
        beside = replace(self, changes=(*self.changes, change), breakpoints=())  # the page pauses where the run does
        return Fork(beside.begun(), replacement_text(graph, change))

    def _about(self, run: Trace, mind: SeenMind, columns: Columns) -> dict[str, Any]:
        setup, task, graph = self.setup, self.setup.task, self.setup.ready.policy.graph
        below = HierarchyData(graph, setup.master, mind.skills, columns)
        return {
            "title": shown(f"{task.name} with {setup.master} in charge, seed {self.seed}"),
            "master": shown(setup.master),
            "source": "simulation",
            "tick": graph.tick,
            "of_ticks": task.ticks,
            "events": WorldEvents(task).data(),
            **run_data(graph, task, self.seed, run.boxes, columns),
            "curves": below.curves([reward.text for reward in task.rewards], not task.scene.environment),
            **below.data(self.texts),
        }


def _compilation() -> str | None:
    return None if is_there(STAGES) else COMPILING


def run_columns(setup: RunSetup, edges: int) -> Columns:
    """The columns of a simulated run."""
    graph, task = setup.ready.policy.graph, setup.task
    doubles, singles = world_columns(len(things_of(task)), len(task.rewards))
    mind = {"readings": graph.width, "influence": len(graph.skills), "commands": len(graph.actuators)}
    return Columns.of(doubles, {**singles, **mind, FLOW: edges})


def run_chunks(
    setup: RunSetup, run: Trace, seed: int, columns: Columns, watching: Watcher | None = None
) -> Iterator[Chunk]:
    """A run as it is made: the only place that knows where rows come from."""
    task, world = setup.task, world_of(setup.task, seed, run.boxes, run.begin, run.things, run.turned)
    of = replace(About.of(setup.ready.policy.graph, "", setup.master, ()), world=world)
    happening, number = WorldEvents(task), 0
    times = np.zeros(len(task.events), np.int64)  # how often each event has happened
    yield beginning(columns, world)
    for ticks in run.chunks:
        so_far = times + np.cumsum(ticks.events, axis=0)
        rows = recorded_rows(of, number + 1, ticks, so_far)
        is_last = run.jobs.lanes[0] == 0
        happened = tuple((number + 1 + int(row), int(event)) for row, event in np.argwhere(happening.in_rows(rows)))
        number, times = number + len(rows), so_far[-1]
        ended = outcome.ended_by(task, int(run.jobs.ended[0])) if is_last else None
        stops = stop_texts(_stops(ticks, so_far, watching))
        both = blocks(rows, columns, rows["readings"])
        yield Chunk(*both, happened, ended and shown(ended), bool(is_last), stops)


def _stops(ticks: Ticks, events: NDArray[np.int64], watching: Watcher | None) -> list[Stop]:
    """Where breakpoints stop a chunk, of which `events` says how often each has happened since the beginning."""
    return watching.feed(Part(ticks.readings, ticks.influence, ticks.commands, events)) if watching else []


def replacement(graph: Graph, task: Task, columns: Columns, asked: messages.Change) -> Change:
    """The change that was asked for; RefusedError where there is no such value, or no such tick."""
    what = next(each for each in get_args(What) if each == asked.what)
    block, index = asked.column
    group = columns[GROUPS[what]]
    row = index - group.first
    sensed = sum(sensor.width for sensor in graph.sensors)
    first, last = {"reading": (0, sensed), "influence": (0, group.count), "memory": (sensed, group.count)}[what]
    if block != group.block or not first <= row < last:
        raise RefusedError(f"column {index} of block {block} has no {what}")
    if asked.tick > task.ticks:
        raise RefusedError(f"tick is a whole number from 1 to {task.ticks}")
    return Change(what, row, (asked.value,), asked.tick, asked.tick + asked.lasts - 1)


def replacement_text(graph: Graph, change: Change) -> str:
    """The change in words."""
    of_skill = change.what == "influence"
    name = graph.skills[change.row].name if of_skill else reading_names(graph)[change.row]
    what = f"the influence of {name} is" if of_skill else f"{name} is"
    ticks = f"tick {change.first}" if change.first == change.last else f"ticks {change.first} to {change.last}"
    return shown(f"{what} {change.values[0]:g} in {ticks}")
