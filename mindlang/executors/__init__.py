"""Executors of jobs by what --on says: one file a kind, `begin(argument, assignment, say)` opens it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from mindrun.errors import MindError

from mindlang.executors.jobs import Assignment, JobExecutor, JobScorer
from mindlang.executors.processes import ProcessJobs

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout

THREADS = "threads"  # of this process: no executor, and no argument
KINDS = ("dask", "processes", "slurm", "ssh")
COMMAND = "command"  # was a kind
INSTEAD_OF_COMMAND = (
    "Dask begins workers now: --on ssh:a,b or --on slurm:8, or by any command: "
    "dask worker --scheduler-file scheduler.json, and --on dask:scheduler.json"
)


@dataclass(frozen=True, slots=True)
class Where:
    """A kind of executor, and what is said of it behind the colon."""

    kind: str
    argument: str

    def __str__(self) -> str:
        return f"{self.kind}:{self.argument}"

    def begin(self, assignment: Assignment, say: Callable[[str], object] = lambda line: None) -> JobExecutor:
        """Workers for the jobs of an assignment, who `say` what they wait for; MindError where there can be none."""
        executor: JobExecutor = import_module(f"{__name__}.{self.kind}").begin(self.argument, assignment, say)
        return executor


@contextmanager
def scorer_on(
    where: Where | None,
    rollout: "Rollout",
    assignment: Callable[[], Assignment],
    workers: int,
    say: Callable[[str], object] = lambda line: None,
) -> "Iterator[Rollout | JobScorer]":
    """A scorer that does as a rollout does, where --on says; its workers are sent away in the end, whatever they do.

    Where --on says nothing the rollout does it in threads; in environments so many processes do, unless 0, since a step
    leaves no thread the interpreter.
    """
    jobs: JobExecutor
    if where is not None:
        jobs = where.begin(assignment(), say)
    elif rollout.task.scene.environment and workers:
        jobs = ProcessJobs(workers, 1, assignment())
    else:
        yield rollout
        return
    try:
        yield JobScorer(rollout, jobs)
    finally:
        jobs.close()


def where(text: str) -> Where | None:
    """The kind of executor that --on says, None for the threads of this process; MindError where there is no such."""
    kind, _, argument = text.partition(":")
    if text == THREADS:
        return None
    if kind == COMMAND:
        raise MindError(f"there is no --on {COMMAND}: any more", INSTEAD_OF_COMMAND)
    if kind not in KINDS:
        hint = f"--on says {THREADS}, or {', '.join(kinds_by_usage().values())}"
        raise MindError(f"nobody knows where {text!r:.60} is", hint)
    module = import_module(f"{__name__}.{kind}")
    if flaw := module.flaw(argument):
        raise MindError(f"{text!r:.60} says no {kind}: {flaw}", f"--on says it so: {module.USAGE}")
    return Where(kind, argument)


def kinds_by_usage() -> dict[str, str]:
    return {kind: import_module(f"{__name__}.{kind}").USAGE for kind in KINDS}
