"""A simulated run that is seen while it is made."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mindrun.engine import changes
from mindrun.engine.engine import procedure_sources
from mindrun.graph.recording_header import About
from mindrun.sim.rollout import Rollout
from mindrun.sim.task_rows import things_of
from mindrun.sim.ticks import Ticks
from mindrun.sim.trace import Trace, trace
from mindrun.sim.warmup import code_of_stages
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.watch import Part, Stop, Watcher, watcher
from mindlang.run import outcome
from mindlang.run.run_recording import recorded_rows, world_of
from mindlang.run.setup import RunSetup
from mindlang.view.about_hierarchy import HierarchyData, Texts
from mindlang.view.about_world import run_data
from mindlang.view.columns import FLOW, Columns
from mindlang.view.environment_images import drawing_of
from mindlang.view.messages import Change
from mindlang.view.recorded_columns import beginning, blocks, world_columns
from mindlang.view.replacement import replacement, replacement_text
from mindlang.view.row_blocks import Chunk
from mindlang.view.stop_texts import stop_texts
from mindlang.view.texts import shown
from mindlang.view.viewed import Fork, SeenMind, Viewed
from mindlang.view.world_events import WorldEvents

COMPILING = "compiling what a changed run takes, once: about a minute…"


@dataclass(frozen=True, slots=True)
class ViewedRun:
    """A run to be seen: `texts` are what its edges say, `breakpoints` are of a setup that notices their events."""

    setup: RunSetup
    rollout: Rollout
    seed: int
    texts: Texts
    breakpoints: Sequence[Breakpoint] = ()
    changes: tuple[changes.Change, ...] = ()

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

    def _forked(self, asked: Change) -> Fork:
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
    return None if code_of_stages().is_there() else COMPILING


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
