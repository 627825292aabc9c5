"""A simulated run that is seen while it is made, and the changes with which a viewer forks it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from mindrun.engine.changes import Change, What
from mindrun.engine.engine import procedure_sources
from mindrun.graph.bundle import Bundle
from mindrun.graph.draws import drawn_in_words, drawn_numbers
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import reading_names
from mindrun.graph.recording_header import About
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Trace, trace

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.watch import RowBlock, watcher
from mindlang.run.recording import recorded_rows, world_of
from mindlang.run.setup import RunSetup
from mindlang.view import messages
from mindlang.view.about import Texts
from mindlang.view.messages import RefusedError, shown
from mindlang.view.rows import Columns
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import RUN, Filled, Watch, viewed_rows

GROUPS: dict[What, str] = {"reading": "readings", "influence": "influence", "memory": "readings"}


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
        setup, task, policy = self.setup, self.setup.task, self.setup.ready.policy
        run = trace(self.rollout, self.seed, changes=self.changes)
        world = world_of(task, self.seed, run.boxes, run.begin, run.things, run.turned)
        of = replace(About.of(policy.graph, "", setup.master, ()), world=world)
        mind = Bundle(policy, procedure_sources(policy.graph, setup.folder, setup.master))
        drawn = drawn_in_words(drawn_numbers(task.draws, self.seed))
        title = f"{task.name} with {setup.master} in charge, seed {self.seed}{drawn}"
        rows, watch = _rows(run, of, len(task.events)), self._watch()
        viewed = viewed_rows(title, RUN, of, mind, task, setup.folder, rows, task.ticks, watch, self.texts)
        viewed.forked = partial(self._forked, viewed.columns)
        return viewed

    def _watch(self) -> Watch | None:
        if not self.breakpoints:
            return None
        watching, drawn = watcher(self.breakpoints, self.setup), drawn_numbers(self.setup.task.draws, self.seed)
        return lambda rows, readings: watching.feed(
            RowBlock(readings, rows["influence"], rows["commands"], rows["world"]["events"].astype(np.int64), drawn)
        )

    def _forked(self, columns: Columns, asked: messages.AskChange) -> tuple[Viewed, str]:
        graph = self.setup.ready.policy.graph
        change = _replacement(graph, self.setup.task, columns, asked)
        beside = replace(self, changes=(*self.changes, change), breakpoints=())  # the page pauses where the run does
        viewed = beside.begun()
        viewed.grow()
        is_influence = change.what == "influence"
        name = graph.skills[change.row].name if is_influence else reading_names(graph)[change.row]
        what = f"the influence of {name} is" if is_influence else f"{name} is"
        ticks = f"tick {change.first}" if change.first == change.last else f"ticks {change.first} to {change.last}"
        return viewed, shown(f"{what} {change.values[0]:g} in {ticks}")


def _rows(run: Trace, of: About, events: int) -> Iterator[Filled]:
    """A run as it is made; what ended it stands in its last row."""
    number, times = 0, np.zeros(events, np.int64)  # how often each event has happened
    for ticks in run.chunks:
        so_far = times + np.cumsum(ticks.events, axis=0)
        rows = recorded_rows(of, number + 1, ticks, so_far)
        if run.jobs.lanes[0] == 0:
            rows["world"]["ended"][-1] = run.jobs.ended[0]
        number, times = number + len(rows), so_far[-1]
        yield rows, rows["readings"]


def _replacement(graph: Graph, task: Task, columns: Columns, asked: messages.AskChange) -> Change:
    """The change that was asked for; RefusedError where there is no such value, or no such tick."""
    what, (block, index) = asked.what, asked.column
    group = columns[GROUPS[what]]
    row = index - group.first
    sensed = sum(sensor.width for sensor in graph.sensors)
    first, last = {"reading": (0, sensed), "influence": (0, group.count), "memory": (sensed, group.count)}[what]
    if block != group.block or not first <= row < last:
        raise RefusedError(f"column {index} of block {block} has no {what}")
    if asked.tick > task.ticks:
        raise RefusedError(f"tick is a whole number from 1 to {task.ticks}")
    return Change(what, row, (asked.value,), asked.tick, asked.tick + asked.lasts - 1)
