"""Jobs on a cluster of Dask: the same bits as on one machine whoever dies or talks nonsense, or one sentence."""

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from mindrun.train.attempt import Segment
from mindrun.train.lesson_state import begin

from mindlang.executors.jobs import StretchExecutor, WorkError
from tests.executors.spheres import ASSIGNMENT
from tests.executors.test_processes import COURSE, taught, timeless
from tests.train.climbing import Sphere
from tests.train.sequential import teach

pytest.importorskip("distributed", reason="distributed is not installed: pip install 'mindlang[cluster]'")

from mindlang.executors import cluster_jobs
from mindlang.executors.cluster_jobs import ClusterJobs
from mindlang.executors.dask import connect, destination

ROOT = Path(__file__).parents[2]
KILLS = 2
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]  # of Dask's own


@pytest.fixture(scope="module", autouse=True)
def sources() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(ROOT / "runtime")]))
        yield


@contextmanager
def begun(workers: int = 1) -> Iterator[Any]:
    """A cluster on this machine, where Dask gives up a job that has cost a worker.

    A LocalCluster ends a nanny for ever whose worker is not there 15 s after one was lost: begun again, or lost again.
    """
    import dask
    from distributed import LocalCluster

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0, "distributed.deploy.lost-worker-timeout": "1h"}),
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster,
    ):
        yield cluster


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    with begun() as cluster:
        yield cluster


@contextmanager
def jobs_of(cluster: Any, function: str = "right", say: Callable[[str], object] = print) -> Iterator[ClusterJobs]:
    found = ClusterJobs(
        connect(destination(cluster.scheduler_address)), ASSIGNMENT, say, f"tests.executors.spheres.{function}"
    )
    try:
        yield found
    finally:
        found.close()


@pytest.fixture(scope="module")
def expected() -> bytes:
    *_, (state, _) = teach(COURSE, Sphere(), begin(COURSE), lambda: 0.0)
    return timeless(state)


def test_the_bits_are_those_of_one_machine(cluster: Any, expected: bytes) -> None:
    with jobs_of(cluster) as jobs:
        assert taught(jobs) == expected


@pytest.mark.parametrize(
    ("function", "words"),
    [
        ("no_answer", "answers with something else"),
        ("raising", "a job failed at .*: RuntimeError: out of luck"),
        ("missing", "has no such mindlang: .*'missing'"),
        ("killing", "a job was lost 5 times, the last time its workers ended, the last at "),
        ("of_another_build", "a worker at .* is of another build: numpy is .* at the worker, and 1.0 where the job"),
    ],
)
def test_a_job_that_cannot_be_done_is_one_sentence(cluster: Any, function: str, words: str) -> None:
    with jobs_of(cluster, function) as jobs, pytest.raises(WorkError, match=words) as error:
        taught(jobs)
    assert len(str(error.value)) <= 1000
    assert error.value.hint


class Killing(StretchExecutor):
    """Kills the worker after each of the first answers."""

    pids: Callable[[], list[int]]
    killed = 0

    def next_result(self) -> tuple[int, Segment] | None:
        done = StretchExecutor.next_result(self)
        if done and Killing.killed < KILLS and (pids := Killing.pids()):
            os.kill(pids[0], signal.SIGKILL)
            Killing.killed += 1
        return done


def test_killed_again_and_again_nothing_is_lost(expected: bytes) -> None:
    with begun() as cluster, jobs_of(cluster, "delayed") as jobs:  # whose worker does not begin anew at this moment
        Killing.pids = lambda: [nanny.pid for nanny in cluster.workers.values() if nanny.pid]
        assert taught(jobs, Killing) == expected
    assert Killing.killed == KILLS


def test_without_workers_it_says_so_and_waits(expected: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster_jobs, "WAIT_SECONDS", 0.0)
    heard = list[str]()

    with begun(workers=0) as cluster:

        def say(line: str) -> None:
            heard.append(line)
            cluster.scale(1)

        with jobs_of(cluster, say=say) as jobs:
            assert taught(jobs) == expected
    assert [line.split(" ")[0] for line in heard] == ["no", "there"]


def test_a_scheduler_that_is_gone_is_one_sentence() -> None:
    with begun() as cluster, jobs_of(cluster, "delayed") as jobs:

        class Closing(StretchExecutor):
            def next_result(self) -> tuple[int, Segment] | None:
                if done := StretchExecutor.next_result(self):
                    cluster.close()
                return done

        with pytest.raises(WorkError, match=r"the scheduler at .* is gone") as error:
            taught(jobs, Closing)
    assert "begin it again" in error.value.hint
