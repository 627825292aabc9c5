"""A robot's recording with something changed: what the mind would have sent for the readings that there were.

Open loop: other commands would have led to other readings, and nobody knows which.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import Change, ChangedEngine, ChangeError, in_tick
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import read_by
from mindrun.robot.recording import About, read
from mindrun.robot.replay import ComputedRow, computed_again
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.run.running_bundle import running_bundle
from mindlang.whatif.difference import Columns, Difference, first_differences, mind_columns
from mindlang.whatif.mind_version import MindVersion

OPEN_LOOP = "open loop: the readings are those of the recording, whatever other commands would have led to"
Thought = tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]  # readings, influence, commands


@dataclass(frozen=True, slots=True)
class Sent:
    """An actuator: in how many ticks its command is another, by how much in the mean and at most, and when that is."""

    name: str
    ticks: int
    mean: float
    most: float
    most_tick: int


@dataclass(frozen=True, slots=True)
class OpenLoop:
    """What of a recording differs; ticks are counted from 1 over the whole recording."""

    master: str
    ticks: int
    differences: list[Difference]
    sent: list[Sent]


def compare_recording(
    path: Path,
    bundle: Path,
    other: MindVersion | None,
    changes: Callable[[Graph, str], Sequence[Change]],
    tick: int,
) -> OpenLoop:
    """Compute a recording as it was and with changes, under another mind from a tick on where there is one.

    RecordingError where the recording was made with another bundle, or is not what this one computes; ChangeError where
    it ends before the tick. Runs the Python code of both minds' procedures.
    """
    about, parts = read(path)
    running = running_bundle(bundle, about)
    mind = MindVersion(bundle.name, running.policy, running.procedures, about.master)
    theirs = other or mind
    ours = Engine(mind.policy, mind.procedures, about.master)
    changed = _Changed(
        ChangedEngine(theirs.policy, theirs.procedures, theirs.master),
        _places(about, mind.graph, theirs),
        changes(theirs.graph, theirs.master),
    )
    computed = computed_again(path, about, chain.from_iterable(parts), ours)
    ticks = [(_thought(each), changed.tick(number, each.row)) for number, each in enumerate(computed, 1)]
    if len(ticks) < tick:
        raise ChangeError(f"{path} has {in_words(len(ticks))}: there is no tick {tick:,}", "say an earlier one")
    was, now = ([*map(np.array, zip(*(each[i] for each in ticks), strict=True))] for i in (0, 1))
    return _compared(about.master, mind_columns(mind.graph, *was), mind_columns(theirs.graph, *now), tick)


def _thought(row: ComputedRow) -> Thought:
    return row.readings, row.influence, row.commands


@dataclass(frozen=True, slots=True)
class _Changed:
    """The mind that is changed; `places` has where its readings stand in a row."""

    engine: ChangedEngine
    places: NDArray[np.intp]
    changes: Sequence[Change]

    def tick(self, number: int, row: Any) -> Thought:
        """What it reads, thinks and sends for what was measured."""
        if row["tick"] == 0:  # begun anew
            self.engine.reset()
        given = np.append(row["readings"], np.float32(np.nan))[self.places]
        commands = self.engine.tick_with(given, in_tick(self.changes, number))
        return self.engine.readings, self.engine.influence, commands


def _places(about: About, graph: Graph, other: MindVersion) -> NDArray[np.intp]:
    """Where in a recorded row each reading of another mind stands; the place after the last is what nobody measured."""
    known = {name: sensor for name, sensor in physical(graph).items() if name in about.sensors}
    wanted = physical(other.graph)
    found = [name for name in wanted if name in known and known[name].width == wanted[name].width]
    read = read_by(other.graph, other.master)
    missing = [name for name in wanted if name in read and name not in found]
    if missing:
        raise ChangeError(f"the recording has no {listed(missing, 'and')}, which {other.name} reads")
    places = np.full(other.graph.width, graph.width, np.intp)
    for name in found:
        sensor = wanted[name]
        places[sensor.start : sensor.start + sensor.width] = known[name].start + np.arange(sensor.width)
    return places


def _compared(master: str, was: dict[str, Columns], now: dict[str, Columns], tick: int) -> OpenLoop:
    """What differs from a tick on; another mind has read along before, and sent nothing."""
    begin = tick - 1
    found = first_differences(_from(was, begin), _from(now, begin))
    differences = [replace(each, tick=each.tick + begin) for each in found]
    ticks = len(next(iter(was["command"].values())))
    both = [name for name in was["command"] if name in now["command"]]
    return OpenLoop(master, ticks, differences, [_sent(name, was["command"], now["command"], begin) for name in both])


def _from(columns: dict[str, Columns], begin: int) -> dict[str, Columns]:
    return {kind: {name: rows[begin:] for name, rows in of.items()} for kind, of in columns.items()}


def _sent(name: str, was: Columns, now: Columns, begin: int) -> Sent:
    apart = np.abs(now[name][begin:].astype(np.float64) - was[name][begin:])
    most_tick = begin + 1 + int(apart.argmax())
    return Sent(name, int(np.count_nonzero(apart)), float(apart.mean()), float(apart.max()), most_tick)
