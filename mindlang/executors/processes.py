"""Processes on this machine, which share its cores: each a pool of one process, whatever that does to itself.

A pool of several would lose the jobs of all with the process of one, and not say whose fault that was. One that ends
is begun anew, and its job is done again; a job that has cost MAX_LOSSES processes is at fault itself, or MAX_STARTS
that had not come to it yet. Environments end none of them: they are stepped in processes of their own, and watched.
"""

import multiprocessing
import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from multiprocessing.context import SpawnContext, SpawnProcess
from queue import Empty, SimpleQueue
from signal import Signals
from threading import Thread
from types import ModuleType
from typing import Any

from mindrun.processors import cores

from mindlang.executors.jobs import FATAL, MAX_LOSSES, TAKE_SECONDS, Assignment, Done, Failed, Work, WorkError
from mindlang.executors.worker import answer, rollout_of

USAGE = "processes:N"
MAX_PROCESSES = 1024
MAX_DIGITS = 4
Make = Callable[[Assignment, int], Any]

MAX_STARTS = 20  # of processes for a job: where others end them, or the machine is busy, few come to it


def flaw(argument: str) -> str:
    """What is wrong with a number of processes; nothing where nothing is."""
    if not (argument.isascii() and argument.isdigit() and len(argument) <= MAX_DIGITS):
        return "it is no whole number"
    return "" if 1 <= int(argument) <= MAX_PROCESSES else f"it is not from 1 to {MAX_PROCESSES}"


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> "ProcessJobs":
    """So many processes."""
    count = int(argument)
    return ProcessJobs(count, max(1, cores() // count), assignment)


class ProcessJobs:
    """The jobs of one assignment, done by so many processes of so many threads each.

    `make` is how an assignment becomes a scorer in a process; it is pickled by its name.
    """

    has_begun = True

    def __init__(self, count: int, threads: int, assignment: Assignment, make: Make = rollout_of) -> None:
        self.assignment = assignment
        self.members = [Member(f"process {number}", assignment, threads, make) for number in range(1, count + 1)]
        self._idle = self.members[::-1]
        self._ended: SimpleQueue[Member] = SimpleQueue()
        for each in self.members:
            each.begin()

    @property
    def workers(self) -> int:
        """How many there are."""
        return len(self.members)

    def has_room(self) -> bool:
        """Whether a process would wait without another job."""
        return bool(self._idle)

    def submit(self, number: int, work: Work) -> None:
        """Ask for a job."""
        member = self._idle.pop()
        member.number, member.work, member.losses, member.starts = number, work, 0, 0
        member.ask(self._ended)

    def take(self) -> tuple[int, Done] | None:
        """The number of a job that has been done, and its answer; None after TAKE_SECONDS without one.

        WorkError where a job cannot be done.
        """
        try:
            member = self._ended.get(timeout=TAKE_SECONDS)
        except Empty:
            return None
        assert member.future is not None
        try:
            found = member.future.result()
        except BrokenProcessPool:
            member.count_loss()
            member.ask(self._ended)
            return None
        self._idle.append(member)
        if isinstance(found, Failed):
            raise WorkError(found.message, found.hint)
        return member.number, found

    def close(self) -> None:
        """End all processes, whatever they do."""
        for each in self.members:
            each.kill()
        for each in self.members:
            each.end()


class Member:
    """A process, which is begun anew with the next job where it has ended; and the job that it is at."""

    number = 0
    work: Work
    future: "Future[Done | Failed] | None" = None
    losses = starts = 0  # processes that the job has cost, and those with others that had not come to it yet

    def __init__(self, name: str, assignment: Assignment, threads: int, make: Make) -> None:
        self.name, self._assignment, self._threads, self._make = name, assignment, threads, make
        self._context = Spawning()
        self._pool: ProcessPoolExecutor | None = None

    @property
    def process(self) -> SpawnProcess | None:
        """The process; None where none has begun."""
        return self._context.process if self._pool is not None else None

    def begin(self) -> ProcessPoolExecutor:
        """Begin the process where there is none, and do not wait until it is ready."""
        if self._pool is None:
            setup = Setup(self._assignment, self._threads, self._make)
            self._pool = ProcessPoolExecutor(1, self._context, _begin, (setup,))
            with no_program():
                self._loaded = self._pool.submit(_load)
        return self._pool

    def ask(self, ended: "SimpleQueue[Member]") -> None:
        """Have the process do its job; it is put into `ended` when there is an answer, or none any more."""
        try:
            self.future = self.begin().submit(_answer, self.work)
        except BrokenProcessPool:  # it has ended since its last job
            self.end()
            self.future = self.begin().submit(_answer, self.work)
        self.future.add_done_callback(lambda future: ended.put(self))

    def count_loss(self) -> None:
        """Take note of an end of the process; WorkError where the job is at fault."""
        self.end()
        has_come_to_it = not self._loaded.cancelled() and self._loaded.exception() is None
        self.losses, self.starts = self.losses + has_come_to_it, self.starts + 1
        if self.losses >= MAX_LOSSES or self.starts >= MAX_STARTS:
            raise WorkError(f"a job has ended {self.starts} workers, the last, {self.name}, {self._ending()}", FATAL)

    def kill(self) -> None:
        """End the process, whatever it does; who waits for its answer is told."""
        if self._pool is not None:
            self._context.process.kill()

    def end(self) -> None:
        """End the process, and wait for that."""
        self.kill()
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
        self._pool = None

    def _ending(self) -> str:
        """How the process has ended."""
        code = self._context.process.exitcode or 0
        return f"by {Signals(-code).name}" if -code in {*Signals} else f"by exit code {code}"


class Spawning(SpawnContext):
    """Begins processes as spawn does, and keeps the last: a pool does not say which are its own."""

    process: SpawnProcess

    def Process(self, *args: Any, **named: Any) -> SpawnProcess:  # type: ignore[override]  # noqa: N802
        """A process that is to be begun."""
        self.process = SpawnProcess(*args, **named)
        return self.process


@contextmanager
def no_program() -> Iterator[None]:
    """Have processes that are begun meanwhile not run the program again that begins them, be it guarded or not."""
    program = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = program


@dataclass(frozen=True, slots=True)
class Setup:
    """What a process is told first."""

    assignment: Assignment
    threads: int
    make: Make


_setup: Setup  # of this process


def _begin(setup: Setup) -> None:
    """What a process does first: it ends with the one that began it, and has no part in its streams and signals."""
    global _setup
    _setup = setup
    os.setsid()  # Ctrl-C at the terminal is for who asks, who lets the work go on to be saved
    os.dup2(2, 1)  # what somebody's code prints is no answer of a command
    Thread(target=_end_with_parent, daemon=True).start()
    sys.path += [f"{setup.assignment.folder}"] if setup.assignment.folder else []


def _end_with_parent() -> None:
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
    os._exit(0)


@cache
def _scorer() -> Any:
    return _setup.make(_setup.assignment, _setup.threads)


def _load() -> None:
    """Have the scorer ready before a job comes; why there is none is the answer to that."""
    with suppress(BaseException):
        _scorer()


def _answer(work: Work) -> Done | Failed:
    """The answer to a job, in the process."""
    return answer(_scorer, work)
