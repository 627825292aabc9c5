"""A worker's side of jobs: the rollout of an assignment, and the answer to a job."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from mindrun.errors import MindError
from mindrun.graph.bundle import unpack

from mindlang.executors.jobs import Assignment, Done, Failed, Work, WorkError, tally_of

if TYPE_CHECKING:
    from mindrun import Rollout

SHOWN_CHARACTERS = 1000  # of why a job failed


def answer(scorer: Callable[[], Any], work: Work) -> Done | Failed:
    """The answer to a job, by what makes the scorer of its assignment; whatever is raised is an answer, too."""
    try:
        made = scorer()
        before, began = tally_of(made), perf_counter()
        result = work.by(made, perf_counter)
        return Done(result, max(0.0, perf_counter() - began), tally_of(made) - before)
    except MindError as error:
        return Failed(str(error), error.hint)
    except BaseException as error:
        return Failed(f"a job failed: {type(error).__name__}: {error}"[:SHOWN_CHARACTERS])


def rollout_of(assignment: Assignment, threads: int) -> Rollout:
    """A rollout of an assignment on so many cores, compiled; the text of its procedures' modules is run.

    WorkError where there is no simulator.
    """
    try:
        rollout_for = import_module("mindrun.sim.rollouts").rollout_for
    except ImportError as error:
        raise WorkError(f"there is no simulator at the worker ({error})", "pip install mindlang there") from error
    bundle = unpack(assignment.bundle)
    with tempfile.TemporaryDirectory(prefix="mind-work-") as folder:
        for module, text in bundle.procedures.items():
            path = Path(folder, *module.split(".")).with_suffix(".py")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        rollout: Rollout = rollout_for(
            bundle.policy,
            assignment.task,
            assignment.master,
            assignment.learners,
            procedures=Path(folder),
            interrupt=assignment.interrupt,
            workers=threads,
        )
        rollout.compile()
    return rollout
