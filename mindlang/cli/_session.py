"""Shared by the commands that simulate: a run set up, the simulator compiled, progress shown, recordings refused."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import NamedTuple

from mindrun.errors import MindError, ProcedureError
from mindrun.graph.run_scores import Scores
from mindrun.robot.replay import DifferenceError
from mindrun.sim import cache
from mindrun.sim.compilation import compile_in_background
from mindrun.sim.rollout import Rollout
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.resolve import load_breakpoints
from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.breakpoints.watch import noticing
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import RunChoice
from mindlang.compiler.compile import Compiled
from mindlang.executors.jobs import JobScorer
from mindlang.limits import refuse_too_large, refuse_too_many
from mindlang.run.chosen_task import SetupError
from mindlang.run.recorded_run import RunResult, run_result
from mindlang.run.setup import NO_GENOME, RunSetup, run_timed, set_up

Ran = Callable[[float], None]  # is told how much more has been done: how many runs, parts of them too

COMPILING_ALL = "compiling all of the simulator (half a minute)…"
COMPILING = "compiling the simulator once (some ten seconds)…"


def ensure_compiled(rollout: Rollout, say: Callable[[str], None] = terminal.complain) -> None:
    """Compile what a rollout needs of the simulator if need be, and say so, and how far it is."""
    units = rollout.units()
    missing = cache.missing(units)
    if missing:
        say(COMPILING)
    with counting("compiling", len(missing), hidden=not missing) as told:
        rollout.compile(told=lambda: told(1))
    if not missing and not all(map(cache.is_native, units)):  # it was shipped, for any processor of its kind
        compile_in_background()


class Prepared(NamedTuple):
    """A run that is set up, and the simulator that makes it."""

    setup: RunSetup
    rollout: Rollout


@dataclass(frozen=True, slots=True)
class RunSession:
    """Talks on stderr, unless the command is to be quiet; what is wrong ends the program with one message."""

    quiet: bool = field(default_factory=partial(terminal.is_asked, "quiet"))

    def prepare(self, file: str, chosen: RunChoice, workers: int = 1, runs: int = 1) -> Prepared:
        """A run that is set up, in the simulator."""
        setup = self.set_up(file, terminal.load_compiled(file), chosen)
        return Prepared(setup, self.simulator(setup, chosen.interrupt, workers, runs))

    @terminal.procedures_talk()
    def set_up(self, file: str, compiled: Compiled, chosen: RunChoice) -> RunSetup:
        """The task, the master and the weights for a run of a compiled file; ends the program where it cannot begin."""
        with refusing_setups():
            found = set_up(file, compiled, chosen.task, chosen.master, robot=chosen.robot)
        self.note(*filter(None, (*found.ready.notes, found.note)))
        return found

    def prepare_stopping(
        self, file: str, compiled: Compiled, chosen: RunChoice, breaks: Path | None
    ) -> tuple[RunSetup, Prepared, tuple[Breakpoint, ...]]:
        """A run that is set up; the one that notices what a .break file asks, in its simulator; its breakpoints."""
        setup, breakpoints = self.set_up(file, compiled, chosen), tuple[Breakpoint, ...]()
        if breaks:
            breakpoints = read_breakpoints(breaks, BreakpointSubject.of_run(compiled.whole[0].names, setup))
        noticed = noticing(setup, breakpoints)
        return setup, Prepared(noticed, self.simulator(noticed, chosen.interrupt)), breakpoints

    @terminal.procedures_talk()
    def simulator(self, setup: RunSetup, interrupt: bool, workers: int = 1, runs: int = 1) -> Rollout:
        """The simulator of a run that is set up, compiled for it."""
        with refusing_setups():
            refuse_too_many(setup.task, runs)
            rollout = setup.rollout(interrupt, workers)
            refuse_too_large(rollout, 1, runs)
            ensure_compiled(rollout, self.say)
        for skill, reason in rollout.procedures.slow.items():
            self.say(f"{skill} runs in Python, which is slow: {reason}")
        return rollout

    @terminal.procedures_talk()
    def score(
        self, scorer: Rollout | JobScorer, seeds: Sequence[int], whose: str = "", ran: Ran | None = None
    ) -> tuple[Scores, float, float]:
        """All runs, the seconds that they took, and those of processors here; notes say `whose` they are.

        With `ran` whoever calls shows progress.
        """
        with nullcontext(ran) if ran else self.counting(scorer.task.name, len(seeds)) as told:
            found = run_timed(scorer, seeds, told)
        self.note(*(f"{whose}{note}" for note in scorer.notes))
        return found

    @terminal.procedures_talk()
    def record(self, setup: RunSetup, rollout: Rollout, seed: int) -> RunResult:
        """A run written down tick by tick, and its outcome."""
        rollout.make_again(NO_GENOME[0], seed)
        made = run_result(setup, rollout, seed)
        self.note(*rollout.notes)
        return made

    def counting(self, what: str, total: int) -> AbstractContextManager[Ran]:
        """Show how much of something has been done; see `counting`."""
        return counting(what, total, self.quiet)

    def say(self, *lines: str) -> None:
        if not self.quiet:
            terminal.tell(*lines)

    def note(self, *notes: str) -> None:
        """Print what is worth knowing beside the result on stderr."""
        self.say(*(f"note: {note}" for note in notes))

    def progress(self) -> Progress:
        """A progress bar on stderr, hidden where that is no terminal."""
        return progress(self.quiet)


@contextmanager
def counting(what: str, total: int, hidden: bool = False) -> Iterator[Ran]:
    """A progress bar of so much, and a function that is told how much more has been done."""
    with progress(hidden) as shown:
        bar = shown.add_task(what, total=total)
        yield lambda more: shown.advance(bar, more)


def progress(hidden: bool) -> Progress:
    """A progress bar on stderr, hidden where that is no terminal."""
    columns = (TextColumn("{task.description}", markup=False), BarColumn(30), TaskProgressColumn())
    talk = terminal.console(stderr=True)
    shown = talk.is_terminal and not hidden
    return Progress(*columns, TimeRemainingColumn(), console=talk, transient=True, disable=not shown)


@contextmanager
def refusing_setups(prefix: str = "") -> Iterator[None]:
    """End the program with one message where a run cannot begin: with 1 where the mind is not ready for it."""
    try:
        yield
    except MindError as error:
        is_unready = isinstance(error, SetupError) and not error.misuse
        terminal.fail(f"{prefix}{error}", error.hint, terminal.FINDINGS if is_unready else terminal.MISUSE)


@contextmanager
def refusing_recordings() -> Iterator[None]:
    """End the program with one message: where a recording is not what its bundle computes with 1, else with 2."""
    found = DifferenceError, ProcedureError
    with terminal.procedures_talk(), terminal.refusing(terminal.MISUSE), terminal.refusing(of=found):
        yield


def read_breakpoints(path: Path, subject: BreakpointSubject) -> tuple[Breakpoint, ...]:
    """The breakpoints of a .break file; a mistake in it is reported, and ends the program before anything runs."""
    found = load_breakpoints(path, subject)
    terminal.print_report(found.diagnostics)
    if found.diagnostics:
        sys.exit(terminal.FINDINGS if all(each.span for each in found.diagnostics) else terminal.MISUSE)
    return found.breakpoints
