"""The rollout of an assignment, at a worker: the policy of its bundle, and its procedures beside nothing else."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.work import WorkError
from mindrun.work.assignment import Assignment

if TYPE_CHECKING:
    from mindrun import Rollout


def rollout_of(assignment: Assignment, threads: int) -> Rollout:
    """What does the jobs of an assignment, compiled; WorkError where its bundle has no such task, master or learner."""
    try:
        from mindrun import Rollout
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
        rollout = Rollout(
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
