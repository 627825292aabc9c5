"""What a worker of Dask runs: a job, the bytes of a frame, to its answer. A thread of Dask does one job at a time."""

from threading import local
from time import perf_counter

from distributed import get_worker
from mindrun.work.assigned import drop, scorer_of
from mindrun.work.frame import unpack
from mindrun.work.serving import STEP_SECONDS
from mindrun.work.worker import KEPT, LACKS, Worker

CORES = "cores"  # the resource by which a worker says that it has others than one for each of its threads

_of_thread = local()


def answer(job: bytes, assignment: bytes = b"") -> bytes:
    """The answer to a job; where what it needs is not known here, the assignment is read first, if it came along."""
    worker = _worker()
    found = worker.answer(job)
    if not assignment or unpack(found).kind != LACKS:
        return found
    kept = worker.answer(assignment)
    return worker.answer(job) if unpack(kept).kind == KEPT else kept


def _worker() -> Worker:
    """That of this thread."""
    if not hasattr(_of_thread, "worker"):
        state = get_worker().state
        cores = int(state.total_resources.get(CORES, state.nthreads))
        threads = max(1, cores // state.nthreads)
        _of_thread.worker = Worker(lambda assignment: scorer_of(assignment, threads, STEP_SECONDS), perf_counter, drop)
    worker: Worker = _of_thread.worker
    return worker
