"""Workers that are processes: what they do is the same bits whoever dies, or it is one sentence."""

import os
import random
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.train.attempt import Segment
from mindrun.train.attempts import side_by_side
from mindrun.train.checkpoint import pack as state_bytes
from mindrun.train.lesson_state import Course, LessonState, begin
from mindrun.train.run_folder import create
from mindrun.train.training import train

from mindlang.executors.jobs import StretchExecutor, WorkError
from mindlang.executors.processes import ProcessJobs
from tests.executors import spheres
from tests.executors.spheres import ASSIGNMENT
from tests.train.climbing import LENGTH, Sphere, lesson, manifest, unwatched
from tests.train.sequential import teach

COURSE = Course(lesson(120, attempts=4, rungs=2), 1, np.empty((0, LENGTH), np.float32))
ROOT = Path(__file__).parents[2]
KILLS = 3
UNGUARDED = """
from tests.executors.test_processes import processes, taught

print("begun")
with processes(1) as jobs:
    taught(jobs)
"""


@contextmanager
def processes(count: int, kind: type[Sphere] = Sphere) -> Iterator[ProcessJobs]:
    found = ProcessJobs(count, 1, ASSIGNMENT, partial(spheres.made, kind))
    try:
        yield found
    finally:
        found.close()


def taught(jobs: Any, make: type[StretchExecutor] = StretchExecutor) -> bytes:
    last = begin(COURSE)
    for step in side_by_side(COURSE, make(COURSE, jobs), last, lambda: False):
        last = step.state
    return timeless(last)


def timeless(state: LessonState) -> bytes:
    return state_bytes(replace(state, seconds=0.0), "")


@pytest.fixture(scope="module")
def expected() -> bytes:
    *_, (state, _) = teach(COURSE, Sphere(), begin(COURSE), lambda: 0.0)
    return timeless(state)


def test_processes_that_end_now_and_then_change_no_bit(expected: bytes) -> None:
    with processes(3, spheres.Dying) as jobs:
        assert taught(jobs) == expected


class Killing(StretchExecutor):
    """Kills a random process after each of the first answers."""

    killed = 0
    rng = random.Random(1)

    def next_result(self) -> tuple[int, Segment] | None:
        done, jobs = StretchExecutor.next_result(self), self.jobs
        assert isinstance(jobs, ProcessJobs)
        process = self.rng.choice(jobs.members).process
        if done and Killing.killed < KILLS and process is not None:
            process.kill()
            Killing.killed += 1
        return done


def test_killed_again_and_again_nothing_is_lost_and_no_process_is_left_behind(expected: bytes) -> None:
    with processes(2, spheres.Slow) as jobs:
        assert taught(jobs, Killing) == expected
        begun = [each.process for each in jobs.members]
    assert Killing.killed == KILLS
    assert [process.exitcode for process in begun if process] == [-9, -9]


def test_a_job_that_fails_is_one_sentence() -> None:
    with processes(1, spheres.Exiting) as jobs, pytest.raises(WorkError, match="SystemExit: out of luck") as error:
        taught(jobs)
    assert len(str(error.value)) <= 1000


def test_a_job_that_costs_every_process_is_at_fault_itself_and_its_run_goes_on_with_others(
    tmp_path: Path, expected: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = create(tmp_path, manifest(COURSE.lesson), {}, {})
    monkeypatch.setattr("mindlang.executors.processes.MAX_LOSSES", 2)
    said = "a job has ended 2 workers, the last, process 1, by SIGKILL"
    with processes(1) as jobs:
        train(run, Sphere(), unwatched(stop_after=2), StretchExecutor(COURSE, jobs))
    with processes(1, spheres.Deadly) as jobs, pytest.raises(WorkError, match=said) as error:
        train(run, Sphere(), unwatched(), StretchExecutor(COURSE, jobs))
    assert "the same job" in error.value.hint
    with processes(1) as jobs:
        state = train(run, Sphere(), unwatched(), StretchExecutor(COURSE, jobs))
    assert timeless(state) == expected


def test_a_program_without_a_guard_is_not_run_again_by_its_processes(tmp_path: Path) -> None:
    (tmp_path / "teach.py").write_text(UNGUARDED)
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    done = subprocess.run(
        [sys.executable, "teach.py"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "begun\n"), done.stderr
