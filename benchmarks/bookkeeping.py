"""What it costs to put attempts side by side: python benchmarks/bookkeeping.py [--attempts 1000] [--segment 10].

Segments are made up, so that CPU time is that of the bookkeeping alone: whose turn it is, what is ahead, the file with
what is ahead. The first attempt comes last of those that are open, which is the most that can be ahead.
"""

import argparse
from collections import deque
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.kinds.learners import Genetic
from mindrun.train.attempt import Segment, Stretch
from mindrun.train.attempts import side_by_side
from mindrun.train.kept_segments import KeptSegments, RememberingExecutor
from mindrun.train.lesson_state import Course, Record, Verdict, begin
from mindrun.train.population import Population

ATTEMPT_COUNTS, GENERATION_COUNTS = (10, 100, 1000), (100, 1000, 10_000)
GENOME_COUNT, WEIGHT_COUNT = 40, 200
LINE = "{attempts:>6,} attempts of {generations:>6,} generations, segments of {segment:>4}, {room:>5,} open"


class MadeUp:
    """Answers stretches with zeros, as many generations each; the first attempt only where no other is open."""

    def __init__(self, course: Course, segment: int, room: int) -> None:
        self.course, self.segment, self.room = course, segment, room
        self.waiting, self.first = deque[tuple[int, Stretch]](), deque[tuple[int, Stretch]]()
        self.genomes, self.scores = (
            np.zeros((GENOME_COUNT, WEIGHT_COUNT), np.float32),
            np.zeros(GENOME_COUNT),
        )
        self.answers = 0

    def has_room(self) -> bool:
        """Whether fewer are open than may be."""
        return len(self.waiting) + len(self.first) < self.room

    def submit(self, job: int, stretch: Stretch) -> None:
        """Take a job."""
        (self.waiting if stretch.number else self.first).append((job, stretch))

    def next_result(self) -> tuple[int, Segment]:
        """Answer the job that waits longest."""
        self.answers += 1
        job, stretch = (self.waiting or self.first).popleft()
        before, end = stretch.state.population.generation, self.course.lesson.generations
        after = min(end, before + self.segment)
        state = replace(
            stretch.state, champion=self.genomes[:1], population=Population(self.genomes, self.scores, after)
        )
        records = tuple(
            Record(stretch.number + 1, at, 0.0, 0.0, None, None, 1, 0.0, 0) for at in range(before + 1, after + 1)
        )
        champions = tuple(np.zeros((after - before, WEIGHT_COUNT), np.float32))
        return job, Segment(state, records, champions, Verdict(np.zeros(2), True, 1, 0) if after == end else None)


class Cost(NamedTuple):
    """Milliseconds of CPU time for a segment: of putting side by side alone, and with the file of what is ahead."""

    alone: float
    with_file: float


def cost(attempts: int, generations: int, segment: int, room: int) -> Cost:
    """Have a made-up lesson taught."""
    lesson = Lesson("School", "Climb", "Climb", "Climb", generations, False, False, Genetic(GENOME_COUNT, attempts))
    course = Course(lesson, 1, np.empty((0, WEIGHT_COUNT), np.float32))
    found = []
    with TemporaryDirectory() as folder:
        for has_file in (False, True):
            made = MadeUp(course, segment, room)
            kept = KeptSegments(Path(folder), "a run", course)
            executor = RememberingExecutor(made, kept, perf_counter) if has_file else made
            began = process_time()
            for _ in side_by_side(course, executor, begin(course), lambda: False):
                pass
            found.append(1000 * (process_time() - began) / made.answers)
    return Cost(*found)


def main() -> None:
    """Measure ever more attempts, and ever more generations of two."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--attempts", type=int, default=ATTEMPT_COUNTS[-1], help="the most (default: 1000)")
    parser.add_argument("--segment", type=int, default=10, help="generations of a segment (default: 10)")
    options = parser.parse_args()
    cases = [(each, 100, options.segment, each) for each in ATTEMPT_COUNTS if each <= options.attempts]
    cases += [(1000, 100, options.segment, 16)] * (options.attempts >= ATTEMPT_COUNTS[-1])
    cases += [(2, each, 1, 2) for each in GENERATION_COUNTS]
    for attempts, generations, segment, room in cases:
        found = cost(attempts, generations, segment, room)
        said = LINE.format(attempts=attempts, generations=generations, segment=segment, room=room)
        print(f"{said}: {found.alone:.3f} ms of CPU a segment, {found.with_file:.3f} with the file", flush=True)


if __name__ == "__main__":
    main()
