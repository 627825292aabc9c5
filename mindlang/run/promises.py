"""What skills promise, counted over runs: how often each promise was kept, and who broke it."""

from collections.abc import Collection, Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from mindrun.engine.promises import BY_INFLUENCE, BY_SKILL, HELD, PromiseWatcher
from mindrun.graph.graph import Graph
from mindrun.numbers.arrays import Singles
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from numpy.typing import NDArray

from mindlang.run.edge_flow import EdgeFlows

MAX_COUNTED_TICKS = 400_000  # of many runs: two seconds or so
FEW_TICKS = 20_000  # of runs in one of many worlds, or after a lesson
VERDICTS = {"held": HELD, "by_skill": BY_SKILL, "by_influence": BY_INFLUENCE}
OF_RUNS = "unfinished", "broken_runs", "broken_runs_by_skill"  # in how many runs


class PromiseCounts:
    """Counts over runs: each promise is judged in some ticks of each; `runs` were counted."""

    def __init__(self, graph: Graph, master: str) -> None:
        self.watcher = PromiseWatcher(graph, master)
        self.runs = 0
        self._times = {name: self._zeros() for name in (*VERDICTS, *OF_RUNS)}

    def add(self, parts: Iterable[Any]) -> int:
        """Count a run, of which parts have `readings` and `influence`; return how many ticks it had."""
        self.watcher.reset()
        ticks, times = 0, {name: self._zeros() for name in VERDICTS}
        for part in parts:
            became = self.watcher.feed(part.readings, part.influence)
            for name, verdict in VERDICTS.items():
                times[name] += (became == verdict).sum(axis=0)
            ticks += len(became)
        by_skill, is_broken = times["by_skill"] > 0, times["by_skill"] + times["by_influence"] > 0
        for name, each in zip(OF_RUNS, (self.watcher.acting, is_broken, by_skill), strict=True):
            times[name] = each.astype(np.int64)
        for name, more in times.items():
            self._times[name] += more
        self.runs += 1
        return ticks

    def _zeros(self) -> NDArray[np.int64]:
        return np.zeros(len(self.watcher.promises), np.int64)

    def data(self) -> list[dict[str, Any]]:
        """Each promise with its counts; those that nobody could break so far are held 0 times."""
        return [
            {
                "skill": skill,
                "promise": promise.text,
                **{name: int(times[i]) for name, times in self._times.items() if name in _told(promise.word)},
                "runs": self.runs,
            }
            for i, (skill, promise) in enumerate(self.watcher.promises)
        ]


def promises_in(
    rollout: Rollout, master: str, seeds: Sequence[int], most: int = MAX_COUNTED_TICKS
) -> list[dict[str, Any]]:
    """The promises of a mind, counted over the first of the runs of these seeds, which are made again for that.

    So many that they have the `most` ticks together, and one at least; none where nothing is promised.
    """
    counts, ticks = PromiseCounts(rollout.graph, master), 0
    for seed in seeds if counts.watcher.promises else ():
        if ticks >= most:
            break
        ticks += counts.add(trace(rollout, seed).chunks)
    return counts.data()


def promises_of(skill: str, flows: EdgeFlows, rows: range) -> list[dict[str, Any]]:
    """What a skill promises, in how many of some rows of a run it is judged, broken and by whom, and where first."""
    watcher = PromiseWatcher(flows.graph, flows.master)
    if not any(owner == skill for owner, _ in watcher.promises):
        return []
    begins = [row for row in range(rows.stop) if row in flows.begins]
    became = judged(watcher, *flows.rows(np.arange(rows.stop)), begins)
    found = []
    for column, (owner, promise) in zip(became[rows.start :].T, watcher.promises, strict=True):
        if owner == skill:
            times = {name: int((column == verdict).sum()) for name, verdict in VERDICTS.items()}
            broken = np.flatnonzero(column >= BY_SKILL)
            first = int(broken[0]) + rows.start + 1 if len(broken) else None
            found.append({"promise": promise.text, **times, "first_broken": first})
    return found


def judged(watcher: PromiseWatcher, readings: Singles, influence: Singles, begins: Collection[int]) -> NDArray[np.int8]:
    """What became of each promise [rows, promises] in the next rows; in those of `begins` the mind begins anew."""
    parts = []
    for first, end in pairwise([0, *begins, len(readings)]):
        if first in begins:
            watcher.reset()
        parts.append(watcher.feed(readings[first:end], influence[first:end]))
    return np.concatenate(parts)


def _told(word: str) -> tuple[str, ...]:
    """The counts that say something of promises of a word."""
    match word:
        case "requires":
            return "held", "by_influence", "broken_runs"
        case "achieves":
            return (*VERDICTS, *OF_RUNS)
    return (*VERDICTS, *OF_RUNS[1:])
