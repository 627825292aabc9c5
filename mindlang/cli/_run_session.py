"""What `run` and `bench` do beside computing: loading a cast, showing progress, and saying so."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter

from mindrun.errors import MindError
from mindrun.sim.rollout import Rollout, Scores
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from mindlang.cli._simulator_compilation import ensure_compiled
from mindlang.cli._terminal import FINDINGS, MISUSE, fail, load_compiled, procedures_talk, say, talk
from mindlang.compiler.compile import Compiled
from mindlang.resource_limits import refuse_too_large, refuse_too_many
from mindlang.run.layouts import NO_GENOME
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.setup import RunSetup, SetupError, set_up


@dataclass(frozen=True, slots=True)
class RunChoice:
    """Which run of a mind it is."""

    task: str | None
    seed: int
    master: str | None
    interrupt: bool


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

    @procedures_talk()
    def score(self, rollout: Rollout, seeds: list[int]) -> tuple[Scores, float]:
        """All runs, and the seconds that they took."""
        with self.progress() as progress:
            bar = progress.add_task(f"{rollout.task.name}", total=len(seeds))
            begin = perf_counter()
            scores = rollout.score(NO_GENOME, seeds, lambda runs: progress.advance(bar, runs))
            seconds = perf_counter() - begin
        self.say(*(f"note: {note}" for note in rollout.notes))
        return scores, seconds

    @procedures_talk()
    def record(self, set_up: RunSetup, rollout: Rollout, seed: int) -> RecordedRun:
        """A run again, tick by tick."""
        from mindlang.run.recorded_run import record_run

        return record_run(set_up, rollout, seed)

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
