"""A simulated run that is seen while it is made."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mindrun import changes
from mindrun.engine import procedure_sources
from mindrun.registry import names
from mindrun.sim.rollout import Rollout
from mindrun.sim.task_rows import things_of
from mindrun.sim.ticks import Ticks
from mindrun.sim.trace import Trace, trace
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.watch import Part, Stop, Watcher, watcher
from mindlang.run import outcome
from mindlang.run.setup import RunSetup
from mindlang.view.about_hierarchy import HierarchyData, Texts
from mindlang.view.about_world import world_data
from mindlang.view.columns import FLOW, POSE_COLUMNS, THING_COLUMNS, Columns
from mindlang.view.messages import Change
from mindlang.view.replacement import replacement, replacement_text
from mindlang.view.row_blocks import Chunk, Doubles, Singles
from mindlang.view.stop_texts import stop_texts
from mindlang.view.texts import shown
from mindlang.view.viewed import Fork, SeenMind, Viewed

NOTHING_HELD = -1
TOUCH, COLLISION = "touch", "collision"  # kinds of events


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
        chunks = run_chunks(setup, run, columns, watching)
        return Viewed(self._about(run, mind, columns), columns, chunks, mind, self._forked)

    def _forked(self, asked: Change) -> Fork:
        setup, graph = self.setup, self.setup.ready.policy.graph
        columns = run_columns(setup, 0)
        change = replacement(graph, setup.task, columns, asked)
        return Fork(replace(self, changes=(*self.changes, change)).begun(), replacement_text(graph, change))

    def _about(self, run: Trace, mind: SeenMind, columns: Columns) -> dict[str, Any]:
        setup, task, graph = self.setup, self.setup.task, self.setup.ready.policy.graph
        below = HierarchyData(graph, setup.master, mind.skills, columns)
        rewards = [reward.text for reward in task.rewards]
        return {
            "title": shown(f"{task.name} with {setup.master} in charge, seed {self.seed}"),
            "task": shown(task.name),
            "master": shown(setup.master),
            "source": "simulation",
            "seed": str(self.seed),
            "tick": graph.tick,
            "of_ticks": task.ticks,
            "events": events_data(setup),
            "rewards": [shown(text) for text in rewards],
            "ends": [shown(text) for text in outcome.ends(task)],
            "world": world_data(graph, task, run.boxes, columns),
            "curves": below.curves(rewards),
            **below.data(self.texts),
        }


def run_columns(setup: RunSetup, edges: int) -> Columns:
    """The columns of a simulated run."""
    graph, task = setup.ready.policy.graph, setup.task
    things = THING_COLUMNS * len(things_of(task))
    return Columns.of(
        {"robot": POSE_COLUMNS, "things": things, "battery": 1, "rewards": len(task.rewards)},
        {
            "held": 1,
            "touching": 1,
            "readings": graph.width,
            "influence": len(graph.skills),
            "commands": len(graph.actuators),
            FLOW: edges,
        },
    )


def events_data(setup: RunSetup) -> list[dict[str, str]]:
    """The events of the task, and touching, where no event of the task says it."""
    kinds = [names()[type(event)] for event in setup.task.events]
    found = [{"text": shown(text), "kind": kind} for text, kind in zip(outcome.events(setup.task), kinds, strict=True)]
    return found if COLLISION in kinds else [*found, {"text": "touch", "kind": TOUCH}]


def run_chunks(setup: RunSetup, run: Trace, columns: Columns, watching: Watcher | None = None) -> Iterator[Chunk]:
    """A run as it is made: the only place that knows where rows come from."""
    yield Chunk(_beginning(run, setup), _nothing_held(columns)[None])
    touched, number = False, 0
    times = np.zeros(len(setup.task.events), np.int64)  # how often each event has happened
    for ticks in run.chunks:
        touching = np.concatenate([[touched], ticks.touching])
        touched = bool(touching[-1])
        happened, is_last = tuple(_happened(setup, ticks, number, touching)), run.jobs.lanes[0] == 0
        number += len(ticks)
        so_far = times + np.cumsum(ticks.events, axis=0)
        times = so_far[-1]
        ended_by, stops = _ended_by(setup, run) if is_last else None, _stops(ticks, so_far, watching)
        yield Chunk(_doubles(ticks), _singles(ticks), happened, ended_by, bool(is_last), stop_texts(stops))


def _beginning(run: Trace, setup: RunSetup) -> Doubles:
    things = np.column_stack([run.things, run.turned])
    return np.concatenate([run.begin, things.ravel(), [np.nan], np.zeros(len(setup.task.rewards))])[None]


def _nothing_held(columns: Columns) -> Singles:
    row = np.zeros(columns.kept_singles, np.float32)
    row[columns["held"].first] = NOTHING_HELD
    return row


def _doubles(ticks: Ticks) -> Doubles:
    things = np.concatenate([ticks.things, ticks.turned[:, :, None]], axis=2).reshape(len(ticks), -1)
    return np.column_stack([ticks.body[:, :POSE_COLUMNS], things, ticks.battery, ticks.lines])


def _singles(ticks: Ticks) -> Singles:
    facts = np.column_stack([ticks.held, ticks.touching]).astype(np.float32)
    return np.column_stack([facts, ticks.readings, ticks.influence, ticks.commands])


def _happened(setup: RunSetup, ticks: Ticks, number: int, touching: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """Ticks and events of a chunk after tick `number`; `touching` begins with the tick before it."""
    happened = [ticks.events > 0]
    if len(events_data(setup)) > len(setup.task.events):
        happened.append((touching[1:] & ~touching[:-1])[:, None])
    for row, event in np.argwhere(np.concatenate(happened, axis=1)):
        yield number + 1 + int(row), int(event)


def _stops(ticks: Ticks, events: NDArray[np.int64], watching: Watcher | None) -> list[Stop]:
    """Where breakpoints stop a chunk, of which `events` says how often each has happened since the beginning."""
    return watching.feed(Part(ticks.readings, ticks.influence, ticks.commands, events)) if watching else []


def _ended_by(setup: RunSetup, run: Trace) -> str | None:
    ended = [*outcome.ends(setup.task), outcome.FLIGHT, None][int(run.jobs.ended[0])]
    return None if ended is None else shown(ended)
