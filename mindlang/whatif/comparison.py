"""A run in the simulator with changes, or under another mind, beside the run as it was; where both differ first."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from mindrun.engine.changes import Change, ChangeError
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import reading_names
from mindrun.graph.run_scores import paid_by_text
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import take_over
from numpy.typing import NDArray

from mindlang.run.recorded_run import ROWS, WITH_BEGINNING, RecordedRun, RunResult, result_of_trace, run_result
from mindlang.run.setup import RunSetup

Array = NDArray[Any]
Columns = Mapping[str, Array]  # by name, a row for each tick
Prepared = tuple[RunSetup, Rollout]  # a run that is set up, in the simulator


@dataclass(frozen=True, slots=True)
class TickDifference:
    """A number of a tick, counted from 1: what it `was`, and what it is `now`, with the changes."""

    tick: int
    what: str
    name: str
    was: float
    now: float

    def as_data(self) -> dict[str, Any]:
        """For `--json`; a number that is not finite is None."""
        return {k: None if isinstance(v, float) and not np.isfinite(v) else v for k, v in asdict(self).items()}


@dataclass(frozen=True, slots=True)
class Compared:
    """A run as it `was` and as it is `now` with changes, and where they differ first, in the order of time."""

    was: RunResult
    now: RunResult
    differences: list[TickDifference]


def compare_runs(
    ours: Prepared, seed: int, tick: int, changes: Sequence[Change], theirs: Prepared | None = None
) -> Compared:
    """Run a seed as it is, and with changes or with another mind from a tick on.

    ChangeError where the run is over before the tick, or the other mind does not fit.
    """
    was = run_result(*ours, seed)
    if tick > was.run.ticks:
        over = f"the run is over after tick {was.run.ticks:,}: there is no tick {tick:,}"
        raise ChangeError(over, "say an earlier one")
    if theirs is None or tick == 1:
        now = run_result(*(theirs or ours), seed, changes)
    else:
        setup, rollout = theirs
        rest = result_of_trace(setup, take_over(ours[1], seed, tick, rollout, changes), seed)
        now = RunResult(_continued(was.run, rest.run, tick - 1), rest.found)
    return Compared(was, now, first_differences(_columns(was.run), _columns(now.run)))


def _continued(was: RecordedRun, rest: RecordedRun, ticks: int) -> RecordedRun:
    """A run whose first ticks are of one run, and the rest of another mind with the same sensors and actuators."""
    before, known = was.until(ticks), was.graph.skill_numbers
    influence = np.full((ticks, len(rest.graph.skills)), np.nan, np.float32)  # NaN of skills that it has alone
    for column, skill in enumerate(rest.graph.skills):
        if skill.name in known:
            influence[:, column] = before.influence[:, known[skill.name]]
    before = replace(before, influence=influence)
    after = replace(rest, events=rest.events + before.events[-1])
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(before, name), getattr(after, name)[name in WITH_BEGINNING :]])
        for name in (*ROWS, "acting")
    }
    return replace(rest, **joined)


def _columns(run: RecordedRun) -> dict[str, Columns]:
    """All numbers of each tick by name, causes before effects."""
    pose = dict(zip(("x", "y", "angle"), run.body[1:].T, strict=True))
    return {
        **mind_columns(run.graph, run.readings, run.influence, run.commands),
        "robot": pose | {"holds": run.held[1:].astype(np.float64)},
        "reward": paid_by_text(run.task.rewards, run.lines),
    }


def mind_columns(graph: Graph, readings: Array, influence: Array, commands: Array) -> dict[str, Columns]:
    """The numbers that a mind reads, thinks and sends in each tick, by name, without those that nobody measured."""
    named = {
        "reading": zip(reading_names(graph), readings.T, strict=True),
        "influence": zip((skill.name for skill in graph.skills), influence.T, strict=True),
        "command": zip((actuator.name for actuator in graph.actuators), commands.T, strict=True),
    }
    return {kind: {name: rows for name, rows in of if not np.isnan(rows).all()} for kind, of in named.items()}


def first_differences(was: Mapping[str, Columns], now: Mapping[str, Columns]) -> list[TickDifference]:
    """The first tick of each kind of numbers, in the order of time: each number that differs in it.

    In one tick they stand in the order of the kinds, which is that of causes. Only names that both have are held
    against each other, in the ticks that both have.
    """
    found: list[TickDifference] = []
    for kind in was:
        pairs = {name: (was[kind][name], now[kind][name]) for name in was[kind] if name in now.get(kind, {})}
        ticks = min((min(len(a), len(b)) for a, b in pairs.values()), default=0)
        cut = {name: (a[:ticks], b[:ticks]) for name, (a, b) in pairs.items()}
        unlike = {name: ~((a == b) | (np.isnan(a) & np.isnan(b))) for name, (a, b) in cut.items()}
        first = min((int(each.argmax()) for each in unlike.values() if each.any()), default=None)
        if first is not None:
            found += [
                TickDifference(first + 1, kind, name, float(a[first]), float(b[first]))
                for name, (a, b) in pairs.items()
                if unlike[name][first]
            ]
    return sorted(found, key=lambda difference: difference.tick)
