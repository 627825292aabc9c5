"""A stepper of environments in a process of their own, watched from this one: whatever one does there, this goes on.

It may end its process, write on standard output, go to another folder or take signals. Where it does not answer in
time, whether it sleeps, holds the interpreter or is stopped, its process is killed.
"""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import cache, cached_property
from mmap import mmap
from multiprocessing.connection import Connection
from pathlib import Path
from signal import Signals
from socket import SO_RCVTIMEO, SO_SNDTIMEO, SOL_SOCKET, socketpair
from struct import Struct
from subprocess import PIPE, Popen, TimeoutExpired
from tempfile import TemporaryFile
from threading import Lock
from typing import Any
from weakref import finalize

from mindrun.errors import MindError
from mindrun.numbers.arrays import Array, Doubles
from mindrun.sim.outside import making
from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.parts import Place, Spaces
from mindrun.sim.outside.stepper import EnvironmentRun, LocalStepper, place_of

STEP_SECONDS, VARIABLE = 60, "MIND_STEP_SECONDS"  # that an environment has for an answer; what says another number
START_SECONDS = 60  # until its process takes questions
LOOK_SECONDS = 0.5  # between two looks at whether it comes any further
SLOW = f"One that needs longer is given it by {VARIABLE}=600, before the command."
STANDARD_ERROR = 2
TIME = Struct("@ll")  # seconds and microseconds, as the system takes them
REACHED = Struct("<I")  # which environment of a question is asked, in memory that outlives the process


class LostError(Exception):
    """A process that has ended, or does not answer: how, and which environment of the question was asked."""

    def __init__(self, how: str, reached: int, is_silent: bool = False) -> None:
        super().__init__(how)
        self.how, self.reached, self.is_silent = how, reached, is_silent


class SilentEnvironmentError(BrokenEnvironmentError):
    """An environment that does not come back."""


class EnvironmentProcess:
    """A process that steps environments; it begins with the first question, and anew where it was lost."""

    def __init__(self) -> None:
        self.step_seconds = _step_seconds()
        self._process: Popen[bytes] | None = None
        self._lock = Lock()

    @property
    def has_begun(self) -> bool:
        """True if the process has been started and is not ended."""
        return self._process is not None

    def ask(self, *question: Any) -> Any:
        """The answer to a question, or the error that it is; LostError where there is none."""
        with self._lock:
            try:
                if self._process is None:
                    self._begin()
                is_done, answer = self._answer(question, self.step_seconds)
            except BaseException:
                self.end()  # its answer would be taken for another one's
                raise
        if not is_done:
            raise answer
        return answer

    def end(self) -> None:
        """Kill the process, whatever it does."""
        if self._process is not None:
            with self._process as process:
                process.kill()
            self._connection.close()
            self._process = None

    def _begin(self) -> None:
        # What is imported here is found there, and nothing else: -P. What is printed comes at once: -u. Ctrl-C is for
        # this process alone: a session of its own. Its standard input ends with this process, and it with that.
        path = os.pathsep.join(each or f"{Path.cwd()}" for each in sys.path)
        ours, theirs = socketpair()
        for limit in (SO_RCVTIMEO, SO_SNDTIMEO):  # of the rest of a message, whatever an environment does to it
            ours.setsockopt(SOL_SOCKET, limit, TIME.pack(int(self.step_seconds), 0))
        self._connection = Connection(ours.detach())
        with theirs, TemporaryFile() as file:
            file.truncate(REACHED.size)
            self._reached = mmap(file.fileno(), REACHED.size)
            inherited = theirs.fileno(), file.fileno()
            self._process = Popen(
                [sys.executable, "-u", "-P", "-m", "mindrun.sim.outside", *map(str, inherited)],
                stdin=PIPE,
                stdout=STANDARD_ERROR,
                pass_fds=inherited,
                start_new_session=True,
                env={**os.environ, "PYTHONPATH": path},
            )
        self._answer(None, START_SECONDS)

    def _answer(self, question: Sequence[Any] | None, seconds: float) -> Any:
        """The answer to a question, of which each environment has so many seconds."""
        REACHED.pack_into(self._reached, 0, 0)
        try:
            if question is not None:
                self._connection.send(question)
            self._wait(seconds)
            return self._connection.recv()
        except LostError:
            raise
        except Exception as error:  # whatever an environment has written there
            raise LostError(self._ending(), self._now()) from error

    def _wait(self, seconds: float) -> None:
        """Wait for an answer. EOFError where the process has ended, even if its child has the socket; LostError where
        one environment is silent for too long.
        """
        before, silent = -1, 0.0
        while not self._connection.poll(LOOK_SECONDS):
            if self._process is None or self._process.poll() is not None:
                raise EOFError
            now = self._now()
            silent = silent + LOOK_SECONDS if now == before else 0.0
            before = now
            if silent >= seconds:
                raise LostError(f"no answer in {seconds:g} seconds", now, is_silent=True)

    def _now(self) -> int:
        """The number of the environment, in the question, that is asked now."""
        found: int = REACHED.unpack(self._reached)[0]
        return found

    def _ending(self) -> str:
        """The end of the process in words: its exit code or signal."""
        assert self._process is not None
        try:
            code = self._process.wait(1)
        except TimeoutExpired:
            return "its answer is none"
        if code >= 0:
            return f"exit code {code}"
        return Signals(-code).name if -code in {*Signals} else f"signal {-code}"


class SubprocessStepper:
    """Steps environments of a name in a process of their own; a module before it is looked for in `folder` first."""

    def __init__(self, environment: str, folder: Path | None = None, process: EnvironmentProcess | None = None) -> None:
        self.environment = environment
        self._about = environment, None if folder is None else folder.absolute()
        self._process = process or EnvironmentProcess()
        self._open = set[EnvironmentRun]()
        if process is None:
            finalize(self, _end, self._process, self._about, self._open)

    @cached_property
    def spaces(self) -> Spaces:
        """The spaces of their observations and actions."""
        found: Spaces = self._ask("spaces", ())
        return found

    def begin(self, places: Sequence[Place], seeds: Sequence[int], is_seen: bool = False) -> list[EnvironmentRun]:
        """A new environment for the run of each seed, of which the numbers at these places are read, one a slot."""
        runs = [EnvironmentRun(seed, len(places)) for seed in seeds]
        self._take("begin", runs, [*places], [*seeds], is_seen)
        self._open.update(runs)
        return runs

    def reset(self, runs: Sequence[EnvironmentRun]) -> None:
        """Begin runs again, each in its environment."""
        self._take("reset", runs)

    def step(self, runs: Sequence[EnvironmentRun], actions: Doubles) -> None:
        """Step each run: the numbers of its action, part after part [runs, numbers]."""
        self._take("step", runs, actions)

    def image(self, run: EnvironmentRun) -> Array:
        """The image of a run now [height, width, 3], red first; an empty array where it draws nothing."""
        found: Array = self._ask("image", [run])
        return found

    def close(self, runs: Sequence[EnvironmentRun]) -> None:
        """Give back what runs hold. One that ends the process by that is told where other runs end with it."""
        closed = [run for run in runs if run in self._open]
        self._open.difference_update(closed)
        are_others = bool(self._open)
        try:
            if closed:
                self._ask("close", closed)
        except BrokenEnvironmentError as error:
            if are_others or isinstance(error, SilentEnvironmentError):
                raise

    def _take(self, method: str, runs: Sequence[EnvironmentRun], *arguments: Any) -> None:
        """Ask, and put the rows of the answer into runs: after a step one later, else at the beginning."""
        for run, row in zip(runs, self._ask(method, runs, *arguments), strict=True):
            run.row, run.steps = row, run.steps + 1 if method == "step" else 0

    def _ask(self, method: str, runs: Sequence[EnvironmentRun], *arguments: Any) -> Any:
        try:
            return self._process.ask(*self._about, method, [run.number for run in runs], *arguments)
        except LostError as lost:
            self._open.clear()
            raise self._blamed(method, runs, lost) from lost

    def _blamed(self, method: str, runs: Sequence[EnvironmentRun], lost: LostError) -> BrokenEnvironmentError:
        """The error of an environment that has not answered: it is silent, or has ended its process."""
        name, where = self.environment, "being asked for its spaces"
        if runs:
            run = runs[min(lost.reached, len(runs) - 1)]
            steps = {"begin": 0, "reset": 0, "step": run.steps + 1}.get(method)
            where = f"its {method} after {run.where}" if steps is None else place_of(run.seed, steps)
        if lost.is_silent:
            message = (
                f"the environment {name} does not come back from {where}, in {self._process.step_seconds:g} seconds"
            )
            return SilentEnvironmentError(message, SLOW, message)
        if not runs:
            message = f"The environment {name} cannot be made."
            return BrokenEnvironmentError(message, f"It has ended the process that asked it ({lost.how}).")
        why = f"It was in {where}, and the fault is the environment's: {lost.how}."
        return BrokenEnvironmentError(f"the environment {name} has ended its process", why, why)


Stepper = LocalStepper | SubprocessStepper


def stepper_for(environment: str, folder: Path | None = None) -> Stepper:
    """A stepper in a process of its own, but for environments that this program alone has registered."""
    if not making.is_there():
        making.library()  # says what to install
    return LocalStepper(environment, folder) if is_own(environment) else SubprocessStepper(environment, folder)


@cache
def known_spaces(environment: str) -> Spaces:
    """The spaces of an environment without a module before its name; BrokenEnvironmentError where there is none."""
    if is_own(environment):
        return LocalStepper(environment).spaces
    return SubprocessStepper(environment, process=_process()).spaces


def is_own(environment: str) -> bool:
    """True if this program alone may know an environment: it has registered that name, or others that are like it."""
    gymnasium = sys.modules.get("gymnasium")
    module, _, name = environment.rpartition(":")
    return gymnasium is not None and (name in gymnasium.registry or not module) and name not in _registered()


@cache
def _registered() -> frozenset[str]:
    """The names of all environments that Gymnasium, and what is installed beside it, have by themselves."""
    try:
        return frozenset(_process().ask("registered"))
    except (MindError, LostError):  # one of the packages beside Gymnasium ends the process
        return frozenset()


@cache
def _process() -> EnvironmentProcess:
    """The process that is asked for spaces, again and again while a mind is written."""
    return EnvironmentProcess()


def _step_seconds() -> float:
    given = os.environ.get(VARIABLE, f"{STEP_SECONDS}")
    if not given.isdecimal() or int(given) == 0:
        raise MindError(f"{VARIABLE} is {given!r:.40}, which is no whole number of seconds")
    return float(given)


def _end(process: EnvironmentProcess, about: Sequence[Any], opened: set[EnvironmentRun]) -> None:
    """Give back what the runs hold that are still open, and end the process."""
    if process.has_begun and opened:
        with suppress(Exception):
            process.ask(*about, "close", [run.number for run in opened])
    process.end()
