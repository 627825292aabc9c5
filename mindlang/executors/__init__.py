"""Where jobs are done, by what --on says: one file a kind, `begin(argument, assignment, say)` opens it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib import import_module
from typing import TYPE_CHECKING

from mindrun.errors import MindError

from mindlang.executors.job_scorer import JobScorer
from mindlang.executors.jobs import STEP_SECONDS, Assignment, JobExecutor
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
STEP_OPTION = ",step-seconds="
MAX_STEP_SECONDS = 86_400


@dataclass(frozen=True, slots=True)
class Where:
    """A kind of executor, what is said of it behind the colon, and how long a step of an environment may take."""

    kind: str
    argument: str
    step_seconds: int = STEP_SECONDS

    def __str__(self) -> str:
        """The words of --on."""
        slow = "" if self.step_seconds == STEP_SECONDS else f"{STEP_OPTION}{self.step_seconds}"
        return f"{self.kind}:{self.argument}{slow}"

    def begin(self, assignment: Assignment, say: Callable[[str], object] = lambda line: None) -> JobExecutor:
        """Workers for the jobs of an assignment, who `say` what they wait for; MindError where there can be none."""
        slow = replace(assignment, step_seconds=self.step_seconds)
        executor: JobExecutor = import_module(f"{__name__}.{self.kind}").begin(self.argument, slow, say)
        return executor


@contextmanager
def scorer_on(
    where: Where | None,
    rollout: Rollout,
    assignment: Callable[[], Assignment],
    workers: int,
    say: Callable[[str], object] = lambda line: None,
) -> Iterator[Rollout | JobScorer]:
    """What scores as a rollout does, where --on says; its workers are sent away in the end, whatever they do.

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
    said, slow, seconds = text.partition(STEP_OPTION)
    kind, _, argument = said.partition(":")
    if text == THREADS:
        return None
    if kind == COMMAND:
        raise MindError(f"there is no --on {COMMAND}: any more", INSTEAD_OF_COMMAND)
    if kind not in KINDS:
        raise MindError(f"nobody knows where {text!r:.60} is", f"--on says {THREADS}, or {usages()}")
    module = import_module(f"{__name__}.{kind}")
    if flaw := module.flaw(argument) or (slow and _flaw_of_seconds(seconds)):
        raise MindError(f"{text!r:.60} says no {kind}: {flaw}", f"--on says it so: {module.USAGE}")
    return Where(kind, argument, int(seconds or STEP_SECONDS))


def usages() -> str:
    """How each kind is said."""
    return ", ".join(kinds_by_usage().values())


def kinds_by_usage() -> dict[str, str]:
    """How each kind is said, by its name."""
    return {kind: import_module(f"{__name__}.{kind}").USAGE for kind in KINDS}


def _flaw_of_seconds(text: str) -> str:
    if text.isascii() and text.isdigit() and len(text) <= len(f"{MAX_STEP_SECONDS}"):
        return "" if 1 <= int(text) <= MAX_STEP_SECONDS else f"a step takes 1 to {MAX_STEP_SECONDS} seconds"
    return "the seconds of a step are no whole number"
