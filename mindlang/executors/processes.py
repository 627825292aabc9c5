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
from functools import lru_cache
from multiprocessing.context import SpawnContext, SpawnProcess
from signal import Signals
from threading import Thread
from types import ModuleType
from typing import Any

from mindrun.processors import cores

from mindlang.executors import jobs
from mindlang.executors.jobs import FATAL, MAX_LOSSES, Assignment, Done, Failed, Job, JobExecutor, Work, WorkError

USAGE = "processes:N"
MAX_PROCESSES = 1024
MAX_DIGITS = 4
MAX_STARTS = 20  # of processes for a job: where others end them, or the machine is busy, few come to it
Make = Callable[[Assignment, int], Any]  # which is pickled by its name


def flaw(argument: str) -> str:
    """The flaw of a number of processes; "" where it has none."""
    if not (argument.isascii() and argument.isdigit() and len(argument) <= MAX_DIGITS):
        return "it is no whole number"
    return "" if 1 <= int(argument) <= MAX_PROCESSES else f"it is not from 1 to {MAX_PROCESSES}"


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> "ProcessJobs":
    count = int(argument)
    return ProcessJobs(count, max(1, cores() // count), assignment)


class ProcessJobs(JobExecutor):
    """The jobs of one assignment, done by so many processes of so many threads; `make` makes the scorer of each."""

    def __init__(self, count: int, threads: int, assignment: Assignment, make: Make = jobs.rollout_of) -> None:
        super().__init__()
        setup = assignment, threads, make
        self.members = [Member(f"process {number}", setup) for number in range(1, count + 1)]
        self._idle = self.members[::-1]
        for each in self.members:
            each.begin()

    @property
    def workers(self) -> int:
        return len(self.members)

    def close(self) -> None:
        for each in self.members:
            each.kill()
        for each in self.members:
            each.end()

    def _future_of(self, job: Job) -> "Future[Done | Failed]":
        member = job.worker = self._idle.pop()
        return member.submit(job.work)

    def _answer(self, future: "Future[Done | Failed]", job: Job) -> Done | Failed | None:
        self._idle.append(job.worker)
        try:
            return future.result()
        except BrokenProcessPool:
            job.worker.count_loss(job)
            return None


class Member:
    """A process, which is begun anew with the next job where it has ended."""

    def __init__(self, name: str, setup: tuple[Assignment, int, Make]) -> None:
        self.name, self._setup = name, setup
        self._context = Spawning()
        self._pool: ProcessPoolExecutor | None = None

    @property
    def process(self) -> SpawnProcess | None:
        return self._context.process if self._pool is not None else None

    def begin(self) -> ProcessPoolExecutor:
        """Begin the process where there is none, and do not wait until it is ready."""
        if self._pool is None:
            self._pool = ProcessPoolExecutor(1, self._context, _begin, self._setup)
            with no_program():
                self._loaded = self._pool.submit(_load)
        return self._pool

    def submit(self, work: Work) -> "Future[Done | Failed]":
        try:
            return self.begin().submit(_answer, work)
        except BrokenProcessPool:  # it has ended since its last job
            self.end()
            return self.begin().submit(_answer, work)

    def count_loss(self, job: Job) -> None:
        """Take note that the process has ended at a job; WorkError where that is at fault."""
        self.end()
        has_come_to_it = not self._loaded.cancelled() and self._loaded.exception() is None
        job.losses, job.starts = job.losses + has_come_to_it, job.starts + 1
        if job.losses >= MAX_LOSSES or job.starts >= MAX_STARTS:
            code = self._context.process.exitcode or 0
            ending = f"by {Signals(-code).name}" if -code in {*Signals} else f"by exit code {code}"
            raise WorkError(f"a job has ended {job.starts} workers, the last, {self.name}, {ending}", FATAL)

    def kill(self) -> None:
        """End the process, whatever it does; who waits for its answer is told."""
        if self._pool is not None:
            self._context.process.kill()

    def end(self) -> None:
        self.kill()
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
        self._pool = None


class Spawning(SpawnContext):
    """Begins processes as spawn does, and keeps the last: a pool does not say which are its own."""

    process: SpawnProcess

    def Process(self, *args: Any, **named: Any) -> SpawnProcess:  # type: ignore[override]  # noqa: N802
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


_scorer: Callable[[], Any]  # of this process


def _begin(assignment: Assignment, threads: int, make: Make) -> None:
    """Set a new process up: it ends with the one that began it, and has no part in its streams and signals."""
    global _scorer
    _scorer = lru_cache(lambda: make(assignment, threads))
    os.setsid()  # Ctrl-C at the terminal is for who asks, who lets the work go on to be saved
    os.dup2(2, 1)  # what somebody's code prints is no answer of a command
    Thread(target=_end_with_parent, daemon=True).start()
    sys.path += [f"{assignment.folder}"] if assignment.folder else []


def _end_with_parent() -> None:
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
    os._exit(0)


def _load() -> None:
    """Have the scorer ready before a job comes; why there is none is the answer to that."""
    with suppress(BaseException):
        _scorer()


def _answer(work: Work) -> Done | Failed:
    return jobs.answer(_scorer, work)
