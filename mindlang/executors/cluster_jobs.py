"""Jobs given to the workers of a Dask cluster, one future each; and what a worker there makes of one.

Dask does the jobs of a worker that is lost again, and gives one up that has cost more than its scheduler allows
(`distributed.scheduler.allowed-failures`, three). That may be bad luck where machines come and go: such a job is asked
again here, MAX_LOSSES times. A worker unpickles a job only where it is of the same build.
"""

import logging
import multiprocessing
import pickle
import re
import ssl
import warnings
from collections.abc import Callable
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from threading import local
from time import monotonic
from typing import Any
from weakref import finalize

from distributed import Client, Future, KilledWorker, get_worker
from distributed.security import Security
from mindrun.train.manifest import Build, difference, own_build, sources_hash

from mindlang.executors import jobs
from mindlang.executors.jobs import Assignment, Done, Failed, Job, JobExecutor, WorkError
from mindlang.executors.processes import ProcessJobs

CONNECT_SECONDS = 10.0
LOOK_SECONDS = 1.0  # between two times that the scheduler is asked for its workers
RESULT_SECONDS = 30.0  # to wait for the bytes of a job that has ended, before who asks may look at something else
WAIT_SECONDS = 5.0  # without a worker, before it is said that there is none
INSTALL = "install the same wheel on the machines of scheduler and workers, and begin them again"
CORES = "cores"  # the resource by which a worker says that it has others than one for each of its threads
KEPT_SCORERS = 4  # scorers that each thread of a worker keeps
DONE, FAILED, REFUSED = "done", "failed", "refused"  # how an answer begins
PLACE = re.compile(r"^in <[^>]*>: ")  # in which of its objects Dask has failed
SHOWN_REASON_CHARACTERS = 300  # of why nobody answers

_thread = local()  # with the scorers of a worker's thread, by the assignment
WireAnswer = tuple[str, bytes] | tuple[str, str, str]  # built-ins alone: whoever has no mindlang can read them


@cache
def cluster_build() -> Build:
    """The build on which jobs and their answers depend: that of mindrun, and a hash of this room, which is pickled."""
    return {**own_build(), "mindlang": sources_hash(Path(__file__).parent)}


def client_of(address: str, security: Security) -> Client:
    """A client of the scheduler at an address. WorkError where nobody answers."""
    silence()
    try:
        with warnings.catch_warnings():
            # Other versions of what results do not depend on: a worker's build says more.
            warnings.simplefilter("ignore")
            return Client(address, security=security, timeout=CONNECT_SECONDS, set_as_default=False, name="mindc")
    except (OSError, ssl.SSLError, ValueError, TypeError, RuntimeError, ImportError) as error:
        said = PLACE.sub("", str(error.__cause__ or error).strip()).splitlines() or ["nothing"]
        hint = "see that the scheduler runs there, and speaks tls or tcp as its address says"
        message = f"no scheduler answers at {address}: {said[0]:.{SHOWN_REASON_CHARACTERS}}"
        raise WorkError(message, hint) from error


def silence() -> None:
    """Have Dask log nothing of connections that fail: whoever asked for them says so."""
    for name in ("client", "comm", "core", "batched", "deploy", "scheduler", "worker", "nanny"):
        logging.getLogger(f"distributed.{name}").setLevel(logging.CRITICAL)


class ClusterJobs(JobExecutor):
    """The jobs of one assignment, done by whoever is connected to a scheduler; `say` is told when nobody is.

    `function` is what a worker of Dask calls with a build, an assignment and a job. It is named and not pickled: a
    worker that does not have it says so, instead of dying of a task that it cannot read. `ended` is called in the end.
    """

    def __init__(
        self,
        client: Client,
        assignment: Assignment,
        say: Callable[[str], object],
        function: str = "mindlang.executors.cluster_jobs.answer_here",
        ended: Callable[[], object] = lambda: None,
    ) -> None:
        super().__init__()
        self._client, self._say, self._when_over = client, say, ended
        module, _, name = function.rpartition(".")
        self._call = f"__import__({module!r}, fromlist=[{name!r}]).{name}(build, assignment, work)"
        self._shared = {"build": dict(cluster_build()), "assignment": pickle.dumps(replace(assignment, folder=None))}
        self._address: str = client.scheduler.address
        self._slots, self._looked = 0, float("-inf")
        self._missed_since: float | None = None
        self._has_said = False
        self.has_begun = False

    @property
    def workers(self) -> int:
        """The number of jobs that can be at work at once: the threads of all workers that are connected."""
        if (now := monotonic()) - self._looked >= LOOK_SECONDS:
            if self._client.status != "running":
                raise self._gone()
            try:
                self._slots, self._looked = sum(self._client.nthreads().values()), now
            except (OSError, RuntimeError, CancelledError) as error:
                raise self._gone() from error
            self._tell(now)
        return self._slots

    def close(self) -> None:
        """Send no more; what is at work ends by itself, and nobody hears of it."""
        with suppress(Exception):  # of a scheduler that is gone, too
            self._client.cancel([*self._open], force=True)
        with suppress(Exception):
            self._client.close(timeout=LOOK_SECONDS)
        self._when_over()

    def _future_of(self, job: Job) -> Future:
        words = {**self._shared, "work": pickle.dumps(job.work)}
        return self._client.submit(eval, self._call, words, pure=False, priority=-job.number)

    def _answer(self, future: Future, job: Job) -> Done | Failed | None:
        """The answer; a worker that does not answer has perhaps been lost, and then it is computed again."""
        try:
            found = future.result(timeout=RESULT_SECONDS)
        except TimeoutError:
            raise
        except CancelledError as error:
            raise self._gone() from error
        except KilledWorker as why:
            job.losses += 1
            if job.losses < jobs.MAX_LOSSES:
                return None
            last = why.last_worker.address
            message = f"a job was lost {job.losses} times, the last time its workers ended, the last at {last}"
            raise WorkError(message, jobs.FATAL) from why
        except (ImportError, AttributeError) as error:
            raise WorkError(f"a worker of {self._address} has no such mindlang: {error}", INSTALL) from error
        except Exception as error:
            said = f"a job failed at {self._address}: {type(error).__name__}: {error}"
            raise WorkError(said[: jobs.SHOWN_CHARACTERS], INSTALL) from error
        future.release()
        match found:
            case "done", bytes(pickled):
                done: Done = pickle.loads(pickled)
                return done
            case "failed", str(message), str(hint):
                return Failed(message, hint)
            case "refused", str(message), str(hint):
                return Failed(f"a worker at {self._address} is of another build: {message}", hint)
        return Failed(f"a worker of {self._address} answers with something else", INSTALL)

    def _gone(self) -> WorkError:
        return WorkError(f"the scheduler at {self._address} is gone", "begin it again, and its workers")

    def _tell(self, now: float) -> None:
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


def jobs_of_cluster(
    cluster: Any, security: Security, assignment: Assignment, say: Callable[[str], object], end: Callable[[], object]
) -> ClusterJobs:
    """The jobs of a cluster that was begun for them: `end` is called when they are over, or nobody answers there."""
    try:
        client = client_of(cluster.scheduler_address, security)
    except BaseException:
        end()
        raise
    return ClusterJobs(client, assignment, say, ended=end)


def answer_here(build: Build, assignment: bytes, work: bytes) -> WireAnswer:
    """The answer of a thread of a worker to a job; REFUSED where the job comes from another build."""
    if differs := difference(build, cluster_build()):
        return REFUSED, differs, "install the same wheel there, and the same versions of what it needs"
    if not hasattr(_thread, "scorer_of"):
        _thread.scorer_of = lru_cache(KEPT_SCORERS)(_scorer)
    found = jobs.answer(lambda: _thread.scorer_of(assignment), pickle.loads(work))
    return (DONE, pickle.dumps(found)) if isinstance(found, Done) else (FAILED, found.message, found.hint)


def _scorer(assignment: bytes) -> Any:
    """The scorer for the jobs of an assignment in a thread of this worker, on its share of the cores.

    An environment is stepped in as many processes: it would leave other threads no interpreter, and may end or hang.
    """
    state = get_worker().state
    threads = max(1, int(state.total_resources.get(CORES, state.nthreads)) // state.nthreads)
    found: Assignment = pickle.loads(assignment)
    rollout = jobs.rollout_of(found, threads)
    if not rollout.task.scene.environment:
        return rollout
    multiprocessing.current_process().daemon = False  # one may have no children
    processes = ProcessJobs(threads, 1, found)
    scorer = jobs.JobScorer(rollout, processes)
    finalize(scorer, processes.close)
    return scorer
