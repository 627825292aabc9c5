"""A run made once: written down tick by tick, and what came of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.engine.changes import Change
from mindrun.sim.rollout import Rollout, scores_of
from mindrun.sim.trace import Trace, trace

from mindlang.run.outcome import run_data
from mindlang.run.recorded_run import RecordedRun, recorded
from mindlang.run.setup import RunSetup


@dataclass(frozen=True, slots=True)
class Course:
    """A run written down, and what came of it (`mindlang.run.outcome.run_data`)."""

    run: RecordedRun
    found: dict[str, Any]


def course(setup: RunSetup, rollout: Rollout, seed: int, changes: Sequence[Change] = ()) -> Course:
    """The run of a seed, with changes."""
    return course_of(setup, trace(rollout, seed, changes=changes), seed)


def course_of(setup: RunSetup, run: Trace, seed: int) -> Course:
    """A run of that seed that is about to begin, made and written down."""
    written = recorded(setup, run)
    found = run_data(setup.task, scores_of(run.jobs, setup.task))
    return Course(written, {"task": setup.task.name, "master": setup.master, "seed": seed} | found)
