"""What scores an assignment, at a worker: the policy of its bundle, and its procedures beside nothing else.

Where its worlds are environments, a worker of several cores has as many workers of one: a step leaves no thread the
interpreter.
"""

from __future__ import annotations

import tempfile
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mindrun.work import WorkError
from mindrun.work.assignment import Assignment
from mindrun.work.job_scorer import JobScorer
from mindrun.work.local import local_workers

if TYPE_CHECKING:
    from mindrun import Rollout


def scorer_of(assignment: Assignment, threads: int, step_seconds: int) -> Any:
    """What does the jobs of an assignment on so many cores."""
    rollout = rollout_of(assignment, threads)
    if not (rollout.task.scene.environment and threads > 1):
        return rollout
    return JobScorer(rollout, local_workers(threads, 1, assignment, step_seconds))


def drop(scorer: Any) -> None:
    """Send its workers away, where a scorer has some."""
    if isinstance(scorer, JobScorer):
        scorer.close()


def rollout_of(assignment: Assignment, threads: int) -> Rollout:
    """What does the jobs of an assignment, compiled; WorkError where its bundle has no such task, master or learner."""
    try:
        rollout_for = import_module("mindrun.sim.rollouts").rollout_for
        here = import_module("mindrun.sim.outside.here").Here  # a worker is a process that may end
    except ImportError as error:
        raise WorkError(f"there is no simulator at the worker ({error})", "pip install mindlang there") from error
    bundle = assignment.opened()
    graph = bundle.graph
    skills, tasks = {skill.name for skill in graph.skills}, {task.name for task in graph.tasks}
    if assignment.task not in tasks or not {assignment.master, *assignment.learners} <= skills:
        raise WorkError("the bundle of a job does not have its task and its skills")
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
            steppers=here,
        )
        rollout.compile()
    return rollout
