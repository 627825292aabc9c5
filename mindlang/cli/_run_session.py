"""What `run` and `bench` do beside computing: loading a cast, showing progress, and saying so."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mindrun.errors import MindError
from mindrun.graph.run_scores import Scores
from mindrun.sim.rollout import Rollout
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from mindlang.cli._simulator_compilation import ensure_compiled
from mindlang.cli._terminal import FINDINGS, MISUSE, fail, load_compiled, procedures_talk, say, talk
from mindlang.compiler.compile import Compiled
from mindlang.executors import Where, scorer_on
from mindlang.executors.jobs import JobScorer
from mindlang.limits import refuse_too_large, refuse_too_many
from mindlang.run.layouts import NO_GENOME
from mindlang.run.many_runs import run_timed
from mindlang.run.setup import RunSetup, SetupError, set_up

if TYPE_CHECKING:
    from mindlang.run.course import Course


@dataclass(frozen=True, slots=True)
class RunChoice:
    """Which run of a mind it is."""

    task: str | None
    seed: int
    master: str | None
    interrupt: bool


@dataclass(frozen=True, slots=True)
class BenchChoice:
    """Which runs are made, and where: in so many `workers` of this machine, or as --on says."""

    task: str | None
    runs: int
    seed: int
    workers: int
    interrupt: bool
    where: Where | None

    @property
    def by(self) -> dict[str, int | str]:
        """Who makes them, for a document."""
        return {"workers": self.workers} if self.where is None else {"on": f"{self.where}"}


@dataclass(frozen=True, slots=True)
class RunSession:
    """Talks on stderr, unless it is to be quiet; what is wrong ends the program with one message."""

    quiet: bool

    @procedures_talk()
    def prepare(
        self, file: str, task: str | None, master: str | None, interrupt: bool, workers: int = 1, runs: int = 1
    ) -> tuple[RunSetup, Rollout]:
        """The cast of a run, in the simulator."""
        return self.prepare_compiled(file, load_compiled(file), task, master, interrupt, workers, runs)

    @procedures_talk()
    def prepare_compiled(
        self,
        file: str,
        compiled: Compiled,
        task: str | None,
        master: str | None,
        interrupt: bool,
        workers: int = 1,
        runs: int = 1,
    ) -> tuple[RunSetup, Rollout]:
        """The cast of a run of a file that is compiled, in the simulator."""
        found = self.cast(file, compiled, task, master)
        return found, self.simulator(found, interrupt, workers, runs)

    @procedures_talk()
    def cast(self, file: str, compiled: Compiled, task: str | None, master: str | None) -> RunSetup:
        """Who plays what."""
        with _refusing():
            found = set_up(file, compiled, task, master)
        self.say(*(f"note: {note}" for note in (*found.ready.notes, found.note) if note))
        return found

    @procedures_talk()
    def simulator(self, setup: RunSetup, interrupt: bool, workers: int = 1, runs: int = 1) -> Rollout:
        """A cast in the simulator, which is compiled for it."""
        with _refusing():
            refuse_too_many(setup.task, runs)
            rollout = setup.rollout(interrupt, workers)
            refuse_too_large(rollout, 1, runs)
            ensure_compiled(rollout, self.say)
        for skill, reason in rollout.procedures.slow.items():
            self.say(f"{skill} runs in Python, which is slow: {reason}")
        return rollout

    def scorer(
        self, setup: RunSetup, rollout: Rollout, chosen: BenchChoice
    ) -> AbstractContextManager[Rollout | JobScorer]:
        """Who makes many runs, where it was said."""
        return scorer_on(chosen.where, rollout, lambda: setup.assignment(chosen.interrupt), chosen.workers, self.say)

    @procedures_talk()
    def score(self, scorer: Rollout | JobScorer, seeds: Sequence[int], whose: str = "") -> tuple[Scores, float, float]:
        """All runs, the seconds that they took, and those of processors here; notes say `whose` they are."""
        with self.progress() as progress:
            bar = progress.add_task(f"{scorer.task.name}", total=len(seeds))
            found = run_timed(scorer, seeds, lambda runs: progress.advance(bar, runs))
        self.say(*(f"note: {whose}{note}" for note in scorer.notes))
        return found

    @procedures_talk()
    def record(self, setup: RunSetup, rollout: Rollout, seed: int) -> Course:
        """A run written down tick by tick, and what came of it."""
        from mindlang.run.course import course

        rollout.make_again(NO_GENOME[0], seed)
        made = course(setup, rollout, seed)
        self.say(*(f"note: {note}" for note in rollout.notes))
        return made

    def say(self, *lines: str) -> None:
        """Print lines on stderr."""
        for line in () if self.quiet else lines:
            talk.print(line, markup=False)

    def progress(self) -> Progress:
        """A bar on stderr, where somebody looks at it."""
        columns = (TextColumn("{task.description}", markup=False), BarColumn(30), TaskProgressColumn())
        hidden = self.quiet or not talk.is_terminal
        return Progress(*columns, TimeRemainingColumn(), console=talk, transient=True, disable=hidden)


@contextmanager
def _refusing() -> Iterator[None]:
    """End the program with one message where a run cannot begin."""
    try:
        yield
    except SetupError as error:
        *first, last = str(error).split("\n")
        for line in first:
            say(line)
        fail(last, error.hint, MISUSE if error.misuse else FINDINGS)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
