"""What a worker of Dask does in the tests: the sphere's jobs, with a fault now and then."""

import os
from functools import cache
from threading import local
from time import perf_counter, sleep

from mindrun.work.frame import unpack
from mindrun.work.worker import LACKS, Worker

from tests.train.climbing import Sphere
from tests.work.working import with_nan

_of_thread = local()
SLOW_SECONDS = 0.05


def right(job: bytes, assignment: bytes = b"") -> bytes:
    """The answer."""
    if not hasattr(_of_thread, "worker"):
        _of_thread.worker = Worker(lambda assignment: Sphere(), perf_counter)
    worker: Worker = _of_thread.worker
    found = worker.answer(job)
    if assignment and unpack(found).kind == LACKS:
        worker.answer(assignment)
        return worker.answer(job)
    return found


def slow(job: bytes, assignment: bytes = b"") -> bytes:
    """The answer, after a while."""
    sleep(SLOW_SECONDS)
    return right(job, assignment)


def nonsense(job: bytes, assignment: bytes = b"") -> bytes:
    """An answer that says too much of nothing."""
    found = right(job, assignment)
    return found if unpack(found).kind == LACKS else with_nan(found)


def now_and_then_nonsense(job: bytes, assignment: bytes = b"") -> bytes:
    """The answer, and each third time one with NaN."""
    return (nonsense if next(_count()) % 3 == 0 else right)(job, assignment)


def garbage(job: bytes, assignment: bytes = b"") -> bytes:
    """Bytes that are no frame."""
    return b"Welcome to Ubuntu 24.04"


def no_bytes(job: bytes, assignment: bytes = b"") -> object:
    """Something else."""
    return {"an": "object"}


def deadly(job: bytes, assignment: bytes = b"") -> bytes:
    """None: the worker ends."""
    os.kill(os.getpid(), 9)
    return b""


def raises(job: bytes, assignment: bytes = b"") -> bytes:
    """An exception that says much."""
    raise RuntimeError("out of " + "luck " * 1000)


@cache
def _count():  # type: ignore[no-untyped-def]
    from itertools import count

    return count(1)
