"""What it costs to give out a job and take its answer: python benchmarks/simulated_workers.py [--jobs 100000].

Workers are simulated: an answer comes after a delay, and one in a hundred is lost with its worker. CPU is that of the
whole process, which is the crew, the jobs as frames, and threads that wait; so it is what a coordinator has to pay.
"""

import argparse
import random
from collections.abc import Sequence
from threading import Lock
from time import perf_counter, process_time, sleep
from typing import NamedTuple

import numpy as np
from mindrun.work.assignment import Assignment
from mindrun.work.child import Child, Place
from mindrun.work.crew import Crew
from mindrun.work.frame import Frame, pack, unpack
from mindrun.work.pipes import LostError
from mindrun.work.worker import answer_to

LOST_SHARE = 0.01
JOB_DELAY_SECONDS = 0.0005  # between two answers, of all workers together, on the mean
JOB_GENOMES, GENOME_WEIGHTS = 25, 100
WORKER_COUNTS, JOB_COUNTS = (10, 100, 1000), (1_000, 10_000, 100_000)
LINE = "{workers:>6,} workers {jobs:>8,} jobs {lost:>6,} lost {cpu:>8.3f} ms of CPU a job {rate:>8,.0f} jobs/s"


class Cost(NamedTuple):
    """What came of some jobs: how many workers were lost, and what a job has taken."""

    lost: int
    cpu_milliseconds: float
    jobs_per_second: float
    answers: dict[int, float]


class Losses:
    """How many workers were lost, counted from all threads."""

    def __init__(self) -> None:
        self.count, self._lock = 0, Lock()

    def add(self) -> None:
        """One more."""
        with self._lock:
            self.count += 1


class SimulatedWorker(Child):
    """Answers a job after a delay, or is lost."""

    def __init__(self, place: Place, delay_seconds: float, losses: Losses) -> None:
        super().__init__(place)
        self._rng, self._delay, self._losses = random.Random(place.name), delay_seconds, losses

    def begin(self) -> None:
        """It is there."""

    def ask(self, data: bytes) -> Frame:
        """The sum of the numbers in a job."""
        sleep(self._rng.expovariate(1 / self._delay))
        if self._rng.random() < LOST_SHARE:
            self._losses.add()
            raise LostError("it was lost")
        return unpack(answer_to(data, Frame("sum", {"sum": float(unpack(data).arrays["genomes"].sum())})))


def cost(workers: int, jobs: int) -> Cost:
    """Have so many jobs done."""
    losses = Losses()
    places = [Place(f"worker {number}", ()) for number in range(workers)]
    delay = JOB_DELAY_SECONDS * workers
    crew = Crew(places, Assignment(b"", "Sum", "Sum"), lambda place: SimulatedWorker(place, delay, losses))
    genomes = np.random.default_rng(1).standard_normal((JOB_GENOMES, GENOME_WEIGHTS), np.float32)
    asked, answers = 0, dict[int, float]()
    began, cpu = perf_counter(), process_time()
    while len(answers) < jobs:
        while asked < jobs and crew.has_room():
            crew.submit(asked, pack(Frame("job", {"number": asked}, {"genomes": genomes})), _sum)
            asked += 1
        if (done := crew.take()) is not None:
            assert done[0] not in answers
            answers[done[0]] = done[1]
    took, seconds = process_time() - cpu, perf_counter() - began
    crew.close()
    return Cost(losses.count, 1000 * took / jobs, jobs / seconds, answers)


def _sum(answer: Frame) -> float:
    value = answer.about["sum"]
    assert isinstance(value, float)
    return value


def main(words: Sequence[str] | None = None) -> None:
    """Measure each number of workers with each number of jobs."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--jobs", type=int, default=JOB_COUNTS[-1], help="the most (default: 100000)")
    options = parser.parse_args(words)
    for workers in WORKER_COUNTS:
        for jobs in (each for each in JOB_COUNTS if each <= options.jobs):
            found = cost(workers, jobs)
            said = {"cpu": found.cpu_milliseconds, "rate": found.jobs_per_second, "lost": found.lost}
            print(LINE.format(workers=workers, jobs=jobs, **said), flush=True)


if __name__ == "__main__":
    main()
