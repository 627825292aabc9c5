"""A run in the simulator with changes, beside the run as it was: the same seed, the same world."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mindrun.engine.changes import Change, ChangeError
from mindrun.graph.run_scores import paid_by_text
from mindrun.sim.rollout import Rollout

from mindlang.run.course import Course, course
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.setup import RunSetup
from mindlang.whatif.difference import Columns, Difference, first_differences, mind_columns

POSE = ("x", "y", "angle")


@dataclass(frozen=True, slots=True)
class Compared:
    """A run as it `was` and as it is `now` with changes, and where they differ first, in the order of time."""

    was: Course
    now: Course
    differences: list[Difference]


def compare(setup: RunSetup, rollout: Rollout, seed: int, changes: Sequence[Change]) -> Compared:
    """Run a seed as it is and with changes; ChangeError where the run is over before the first of them."""
    was = course(setup, rollout, seed)
    first = min((change.first for change in changes), default=1)
    refuse_late(was, first)
    return compared(was, course(setup, rollout, seed, changes))


def refuse_late(was: Course, tick: int) -> None:
    """ChangeError where a run is over before a tick."""
    if tick > was.run.ticks:
        raise ChangeError(
            f"the run is over after tick {was.run.ticks:,}: there is no tick {tick:,}", "say an earlier one"
        )


def compared(was: Course, now: Course) -> Compared:
    """Two runs held against each other."""
    return Compared(was, now, first_differences(_columns(was.run), _columns(now.run)))


def _columns(run: RecordedRun) -> dict[str, Columns]:
    """All numbers of each tick by name, in the order in which one comes of the other."""
    return {
        **mind_columns(run.graph, run.readings, run.influence, run.commands),
        "robot": {name: run.body[1:, i] for i, name in enumerate(POSE)} | {"holds": run.held[1:].astype(np.float64)},
        "reward": paid_by_text(run.task.rewards, run.lines),
    }
