"""Jobs given to the workers of a Dask cluster: one future each, bytes in and bytes out.

Dask does the jobs of a worker that is lost again, and gives one up that has cost more than its scheduler allows
(`distributed.scheduler.allowed-failures`, three). That may be bad luck where machines come and go: such a job is asked
again here, and so is one whose answer is nonsense, five times.
"""

from collections.abc import Callable
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import dataclass
from queue import Empty, Queue
from time import monotonic
from typing import Any

from distributed import Client, Future, KilledWorker
from mindrun.work import WorkError
from mindrun.work.assignment import Assignment
from mindrun.work.crew import FATAL, MAX_LOSSES, TAKE_SECONDS, refusal
from mindrun.work.executor import Read
from mindrun.work.frame import Frame, FrameError, unpack
from mindrun.work.worker import LACKS

LOOK_SECONDS = 1.0  # between two times that the scheduler is asked for its workers
RESULT_SECONDS = 30.0  # to wait for the bytes of a job that has ended, before who asks may look at something else
WAIT_SECONDS = 5.0  # without a worker, before it is said that there is none
INSTALL = "install the same wheel on the machines of scheduler and workers, and begin them again"


@dataclass(slots=True)
class Job:
    """A job at a worker."""

    number: int
    data: bytes
    read: Read
    losses: int = 0  # times that Dask gave it up, and answers that were nonsense
    has_assignment: bool = False  # beside it, for a worker that lacks that


class ClusterJobs:
    """The jobs of one assignment, done by whoever is connected to a scheduler; `say` is told when nobody is.

    `function` is what a worker of Dask calls with a job, and with the assignment where it has said that it lacks that.
    It is named and not pickled: a worker that does not have it says so, instead of dying of a task that it cannot read.
    """

    def __init__(
        self,
        client: Client,
        assignment: Assignment,
        say: Callable[[str], object],
        function: str = "mindlang.cluster.answering.answer",
    ) -> None:
        self.assignment = assignment
        self._client, self._say = client, say
        module, _, name = function.rpartition(".")
        self._call = f"__import__({module!r}, fromlist=[{name!r}]).{name}(job, assignment)"
        self._address: str = client.scheduler.address
        self._open: dict[Future, Job] = {}
        self._done: Queue[Future] = Queue()
        self._slots, self._looked = 0, float("-inf")
        self._missed_since: float | None = None
        self._has_said = False
        self.has_begun = False

    @property
    def workers(self) -> int:
        """How many jobs can be at work at once: the threads of all workers that are connected."""
        if (now := monotonic()) - self._looked >= LOOK_SECONDS:
            self._slots, self._looked = self._found_slots(), now
            self._tell(now)
        return self._slots

    def has_room(self) -> bool:
        """Whether a worker would wait without another job."""
        return len(self._open) < self.workers

    def submit(self, number: int, data: bytes, read: Read) -> None:
        """Ask for a job, the bytes of a frame; `read` says what its answer means."""
        self._submit(Job(number, data, read))

    def take(self) -> tuple[int, Any] | None:
        """A job and what came of it; None where for a while none came. WorkError where none can come any more."""
        try:
            future = self._done.get(timeout=TAKE_SECONDS)
        except Empty:
            self.workers  # noqa: B018  # looks whether there are any
            return None
        job = self._open.pop(future)
        try:
            if (found := self._result(future)) is None:
                self._open[future] = job
                self._done.put(future)
                return None
            return self._read(job, unpack(found))
        except KilledWorker as why:
            flaw, hint = f"its workers ended, the last at {why.last_worker.address}", FATAL
        except FrameError as why:
            flaw, hint = f"its answer was nonsense: {why}", "install the same mindlang on the cluster's workers"
        job.losses += 1
        if job.losses >= MAX_LOSSES:
            raise WorkError(f"a job was lost {job.losses} times, the last time {flaw}", hint)
        self._submit(job)
        return None

    def close(self) -> None:
        """Send no more; what is at work ends by itself, and nobody hears of it."""
        with suppress(Exception):  # of a scheduler that is gone, too
            self._client.cancel([*self._open], force=True)
        with suppress(Exception):
            self._client.close(timeout=LOOK_SECONDS)

    def _read(self, job: Job, answer: Frame) -> tuple[int, Any] | None:
        """What an answer means; None of a worker that lacks the assignment, and is asked again with it."""
        if answer.kind == LACKS:
            if job.has_assignment:
                raise FrameError("the worker lacks what it was told")
            job.has_assignment = True
            self._submit(job)
            return None
        if (error := refusal(self._address, answer)) is not None:
            raise error
        return job.number, job.read(answer)

    def _submit(self, job: Job) -> None:
        words = {"job": job.data, "assignment": self.assignment.packed if job.has_assignment else b""}
        future = self._client.submit(eval, self._call, words, pure=False, priority=-job.number)
        self._open[future] = job
        future.add_done_callback(self._done.put)

    def _result(self, future: Future) -> bytes | None:
        """The bytes that a future has come to; KilledWorker where Dask gave it up, WorkError where it has come to none.

        None where they are on a worker that does not answer: if it was lost, they are computed again.
        """
        try:
            found = future.result(timeout=RESULT_SECONDS)
        except TimeoutError:
            return None
        except CancelledError as error:
            raise self._gone() from error
        except KilledWorker:
            raise
        except (ImportError, AttributeError) as error:
            raise WorkError(f"a worker of {self._address} has no such mindlang: {error}", INSTALL) from error
        except Exception as error:
            raise WorkError(
                f"a job failed at {self._address}: {type(error).__name__}: {error}"[:1000], INSTALL
            ) from error
        future.release()
        if not isinstance(found, bytes):
            raise WorkError(f"a worker of {self._address} answers with no bytes", INSTALL)
        return found

    def _found_slots(self) -> int:
        """The threads of all workers; WorkError where the scheduler does not answer."""
        if self._client.status != "running":
            raise self._gone()
        try:
            return sum(self._client.nthreads().values())
        except (OSError, RuntimeError, CancelledError) as error:
            raise self._gone() from error

    def _gone(self) -> WorkError:
        return WorkError(f"the scheduler at {self._address} is gone", "begin it again, and its workers")

    def _tell(self, now: float) -> None:
        """Say that there is no worker, and later that there is one."""
        if self._slots:
            self.has_begun = True
            if self._has_said:
                self._say("there are workers again")
            self._missed_since, self._has_said = None, False
            return
        self._missed_since = now if self._missed_since is None else self._missed_since
        if now - self._missed_since >= WAIT_SECONDS and not self._has_said:
            self._say(f"no worker is connected to {self._address}: waiting for one (Ctrl-C stops)")
            self._has_said = True
