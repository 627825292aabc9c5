"""The run of a seed under another mind: from its first tick on, or taken over in the middle."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np
from mindrun.engine.changes import Change
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import take_over
from numpy.typing import NDArray

from mindlang.run.course import Course, course, course_of
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.setup import RunSetup
from mindlang.whatif.changed_run import Compared, compared, refuse_late

ROWS_BEFORE = ("body", "things", "turned", "held")  # which have a row for the beginning, too


def compare_minds(
    ours: tuple[RunSetup, Rollout], theirs: tuple[RunSetup, Rollout], seed: int, tick: int, changes: Sequence[Change]
) -> Compared:
    """The run of a seed as it is, and with another mind from a tick on; ChangeError where that one does not fit."""
    was = course(*ours, seed)
    refuse_late(was, tick)
    if tick == 1:
        return compared(was, course(*theirs, seed, changes))
    setup, rollout = theirs
    rest = course_of(setup, take_over(ours[1], seed, tick, rollout, changes), seed)
    return compared(was, Course(continued(was.run, rest.run, tick - 1), rest.found))


def continued(was: RecordedRun, rest: RecordedRun, ticks: int) -> RecordedRun:
    """So many ticks of a run, and what came after them under another mind of the same sensors and actuators."""
    rows = {field.name for field in fields(RecordedRun)} - {"setup", "boxes", "influence", "events", "ended"}
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(was, name)[: ticks + (name in ROWS_BEFORE)], _after(rest, name)]) for name in rows
    }
    return replace(
        rest,
        **joined,
        influence=np.concatenate([_influence(was, rest)[:ticks], rest.influence]),
        events=np.concatenate([was.events[:ticks], rest.events + was.events[ticks - 1]]),
    )


def _after(rest: RecordedRun, name: str) -> NDArray[Any]:
    rows: NDArray[Any] = getattr(rest, name)
    return rows[1:] if name in ROWS_BEFORE else rows


def _influence(was: RecordedRun, rest: RecordedRun) -> NDArray[np.float32]:
    """The influence [ticks, skills] of a run in the columns of another mind: NaN of skills that it has alone."""
    known = was.graph.skill_numbers
    found = np.full((was.ticks, len(rest.graph.skills)), np.nan, np.float32)
    for column, skill in enumerate(rest.graph.skills):
        if skill.name in known:
            found[:, column] = was.influence[:, known[skill.name]]
    return found
