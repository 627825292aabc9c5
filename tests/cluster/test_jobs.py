"""Jobs on a cluster of Dask: the same bits as on one machine whoever dies or talks nonsense, or one sentence."""

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.train.attempts import side_by_side
from mindrun.train.lesson import teach
from mindrun.train.lesson_state import Course, begin
from mindrun.train.segment import Segment
from mindrun.work import WorkError
from mindrun.work.executor import StretchExecutor
from mindrun.work.frame import Frame, pack

from tests.train.climbing import LENGTH, Sphere, lesson
from tests.work.test_crew import timeless
from tests.work.working import ASSIGNMENT

pytest.importorskip("distributed", reason="distributed is not installed: pip install 'mindlang[cluster]'")

from mindlang.cluster import jobs as cluster_jobs
from mindlang.cluster.connection import connect
from mindlang.cluster.jobs import ClusterJobs
from mindlang.cluster.scheduler import destination

COURSE = Course(lesson(250, attempts=5, rungs=2), 1, np.empty((0, LENGTH), np.float32))
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
        connect(destination(cluster.scheduler_address)), ASSIGNMENT, say, f"tests.cluster.answers.{function}"
    )
    try:
        yield found
    finally:
        found.close()


def taught(jobs: ClusterJobs, make: type[StretchExecutor] = StretchExecutor) -> bytes:
    last = begin(COURSE)
    for step in side_by_side(COURSE, make(COURSE, jobs), last, lambda: False):
        last = step.state
    return timeless(last)


@pytest.fixture(scope="module")
def expected() -> bytes:
    *_, (state, _) = teach(COURSE, Sphere(), begin(COURSE), lambda: 0.0)
    return timeless(state)


@pytest.mark.parametrize("function", ["right", "now_and_then_nonsense"])
def test_the_bits_are_those_of_one_machine(cluster: Any, expected: bytes, function: str) -> None:
    with jobs_of(cluster, function) as jobs:
        assert taught(jobs) == expected


@pytest.mark.parametrize(
    ("function", "words"),
    [
        ("nonsense", "a job was lost 5 times, the last time its answer was nonsense: "),
        ("garbage", "a job was lost 5 times, .* nonsense: it begins with b'Welcome "),
        ("no_bytes", "answers with no bytes"),
        ("raises", "a job failed at .*: RuntimeError: out of luck"),
        ("missing", "has no such mindlang: .*'missing'"),
        ("deadly", "a job was lost 5 times, the last time its workers ended, the last at "),
    ],
)
def test_a_job_that_cannot_be_done_is_one_sentence(cluster: Any, function: Callable[..., Any], words: str) -> None:
    with jobs_of(cluster, function) as jobs, pytest.raises(WorkError, match=words) as error:
        taught(jobs)
    assert len(str(error.value)) <= 1000
    assert error.value.hint


def test_a_worker_of_another_build_refuses_in_words(cluster: Any) -> None:
    with jobs_of(cluster) as jobs:
        about = {"build": {"numpy": "1.0"}, "assignment": ASSIGNMENT.name}
        jobs.submit(1, pack(Frame("advance", about)), lambda answer: answer)
        with pytest.raises(WorkError, match="of another build: mindrun is") as error:
            next(filter(None, iter(jobs.take, 0)))
    assert "install the same" in error.value.hint


class Killing(StretchExecutor):
    """Kills the worker after each of the first answers."""

    pids: Callable[[], list[int]]
    killed = 0

    def take(self) -> tuple[int, Segment] | None:
        done = StretchExecutor.take(self)
        if done and Killing.killed < KILLS and (pids := Killing.pids()):
            os.kill(pids[0], signal.SIGKILL)
            Killing.killed += 1
        return done


def test_killed_again_and_again_nothing_is_lost(expected: bytes) -> None:
    with begun() as cluster, jobs_of(cluster, "slow") as jobs:  # whose worker does not begin anew at this moment
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
    with begun() as cluster, jobs_of(cluster, "slow") as jobs:

        class Closing(StretchExecutor):
            def take(self) -> tuple[int, Segment] | None:
                if done := StretchExecutor.take(self):
                    cluster.close()
                return done

        with pytest.raises(WorkError, match=r"the scheduler at .* is gone") as error:
            taught(jobs, Closing)
    assert "begin it again" in error.value.hint
