"""Who does the attempts of a lesson in the benchmarks of executors: each is begun with so many cores, and ended."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from distributed import LocalCluster
from mindrun.sim.rollout import Rollout
from mindrun.train.attempts import AttemptExecutor, StretchThreads
from mindrun.train.lesson_state import Course

from mindlang.executors.cluster_jobs import ClusterJobs
from mindlang.executors.dask import Destination, connect
from mindlang.executors.jobs import Assignment, StretchExecutor
from mindlang.executors.processes import ProcessJobs, begin

Begin = Callable[
    [Course, Rollout], AttemptExecutor | None
]  # what does the attempts of a course; None where nobody does
Pids = Callable[[], list[int]]


@contextmanager
def one_by_one(count: int, assignment: Assignment) -> Iterator[tuple[Begin, Pids]]:
    """No other process, and each generation split."""
    yield lambda course, rollout: None, list[int]


@contextmanager
def threads(count: int, assignment: Assignment) -> Iterator[tuple[Begin, Pids]]:
    """No other process, and each attempt a thread."""
    yield lambda course, rollout: StretchThreads(course, count, rollout.on, time.perf_counter), list[int]


@contextmanager
def processes(count: int, assignment: Assignment) -> Iterator[tuple[Begin, Pids]]:
    """A pool of one process for each."""
    jobs = begin(f"{count}", assignment, print)
    try:
        yield lambda course, rollout: StretchExecutor(course, jobs), lambda: pids(jobs)
    finally:
        jobs.close()


def pids(jobs: ProcessJobs) -> list[int]:
    """The processes that are there."""
    return [each.process.pid for each in jobs.members if each.process and each.process.pid]


@contextmanager
def dask(count: int, assignment: Assignment) -> Iterator[tuple[Begin, Pids]]:
    """A cluster of Dask on this machine, with so many workers of one thread."""
    with LocalCluster(count, threads_per_worker=1, dashboard_address=":0", silence_logs="CRITICAL") as cluster:
        jobs = ClusterJobs(connect(Destination(cluster.scheduler_address)), assignment, print)
        try:
            there = cluster.scheduler.workers
            yield (
                lambda course, rollout: StretchExecutor(course, jobs),
                lambda: [each.pid for each in cluster.workers.values() if each.worker_address in there],
            )
        finally:
            jobs.close()
