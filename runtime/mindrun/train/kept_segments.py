"""Segments of attempts ahead of their turn, in a file of the run: a run that goes on has not to do them again.

One of them answers any stretch that begins where it did, since a segment depends on its stretch alone. The file has the
form of a checkpoint; one that is damaged, or of another run or build, is as none.
"""

from contextlib import suppress
from dataclasses import astuple, fields
from math import isnan, nan
from pathlib import Path

import numpy as np

from mindrun.files.atomic_write import write
from mindrun.files.regular_files import read_whole
from mindrun.train.attempt import Clock, Segment, Stretch
from mindrun.train.attempts import AttemptExecutor
from mindrun.train.checkpoint import Arrays, attempt_state, sealed, unsealed
from mindrun.train.lesson_state import AttemptState, Course, Record, Verdict, begin_attempt, rung_at
from mindrun.train.manifest import own_build

NAME = "ahead"
MAGIC = b"mind attempts ahead 2\n"
MAX_FILE_BYTES = 1 << 30
SAVE_SECONDS = 2.0  # between two times that the file is written anew, at least
MAX_SAVE_SHARE = 0.05  # of the time that goes into writing it

Chain = list[Segment]  # of an attempt, from rung to rung, each from where that before ends


class KeptSegments:
    """The kept segments of a run, at first those in its file; attempts that the lesson has come past are forgotten."""

    def __init__(self, folder: Path, identity: str, course: Course) -> None:
        self.path, self.course = folder / NAME, course
        self._said = {"run": identity, "build": dict(own_build())}
        self.chains: dict[int, Chain] = {}
        with suppress(OSError, ValueError, LookupError, TypeError, MemoryError):
            self.chains = self._read(read_whole(self.path, MAX_FILE_BYTES))

    def find(self, stretch: Stretch) -> Segment | None:
        """The segment that begins where a stretch does; None where none is kept."""
        before = begin_attempt(self.course)
        for segment in [] if stretch.cut else self.chains.get(stretch.number, []):
            if is_same(before, stretch.state):
                return segment
            before = segment.state
        return None

    def put(self, stretch: Stretch, segment: Segment) -> None:
        """Keep what came of a stretch, where all before it has been kept."""
        chain = self.chains.setdefault(stretch.number, [])
        start = chain[-1].state if chain else begin_attempt(self.course)
        if stretch.cut or not is_same(start, stretch.state):
            return
        if chain and rung_at(self.course.lesson, start.population.generation) is None:
            segment = chain.pop().then(segment)
        chain.append(segment)

    def forget(self, below: int) -> None:
        self.chains = {number: chain for number, chain in self.chains.items() if number >= below}

    def save(self) -> None:
        """Write the file, as far as that can be: it spares work, and nothing depends on it."""
        if not any(self.chains.values()):
            self.path.unlink(missing_ok=True)
            return
        arrays = {
            f"{number} {place} {name}": array
            for number, chain in self.chains.items()
            for place, segment in enumerate(chain)
            for name, array in _arrays(segment).items()
        }
        with suppress(OSError):
            write(self.path, sealed(MAGIC, self._said, arrays))

    def _read(self, data: bytes) -> dict[int, Chain]:
        """The chains in the bytes of a file; none where it is damaged, or of another run."""
        segments = dict[tuple[int, int], Arrays]()
        for key, array in (unsealed(MAGIC, self._said, data) or {}).items():
            number, place, name = key.split()
            segments.setdefault((int(number), int(place)), {})[name] = array
        chains = dict[int, Chain]()
        for (attempt, _), found in sorted(segments.items(), key=lambda each: each[0]):
            chains.setdefault(attempt, []).append(_segment(found, self.course))
        return chains


class RememberingExecutor:
    """An executor that answers with kept segments, and leaves the other stretches to another executor."""

    def __init__(self, stretches: AttemptExecutor, kept: KeptSegments, clock: Clock) -> None:
        self._stretches, self._kept, self._clock = stretches, kept, clock
        self._due = clock() + SAVE_SECONDS
        self._first = self._at = -1  # the attempt that the lesson was at, which checkpoints have; and is at now
        self._ended = set[int]()
        self._asked: dict[int, Stretch] = {}
        self._found: list[tuple[int, Segment]] = []

    def has_room(self) -> bool:
        return self._stretches.has_room()

    def submit(self, job: int, stretch: Stretch) -> None:
        """The first stretch is of the attempt that the lesson is at."""
        if self._first < 0:
            self._first = self._at = stretch.number
        self._asked[job] = stretch
        if (segment := self._kept.find(stretch)) is not None:
            self._found.append((job, segment))
        else:
            self._stretches.submit(job, stretch)

    def next_result(self) -> tuple[int, Segment] | None:
        done = self._found.pop(0) if self._found else self._stretches.next_result()
        if done is None:
            return None
        job, segment = done
        stretch = self._asked.pop(job)
        if stretch.number > self._first:
            self._kept.put(stretch, segment)
        if segment.verdict is not None:
            self._ended.add(stretch.number)
        while self._at in self._ended:  # the lesson has come past it: all up to there have ended
            self._at += 1
            self._kept.forget(self._at)
        if (began := self._clock()) >= self._due:
            self._kept.save()
            now = self._clock()
            self._due = now + max(SAVE_SECONDS, (now - began) / MAX_SAVE_SHARE)
        return done


def is_same(one: AttemptState, other: AttemptState) -> bool:
    """True if two states of an attempt have the same generation, population and champion."""
    both = (one.population, one.champion), (other.population, other.champion)
    states = ((of.generation, of.genomes, of.scores, champion) for of, champion in both)
    return one is other or all(map(np.array_equal, *states))


def _arrays(segment: Segment) -> Arrays:
    state, verdict = segment.state, segment.verdict
    records = [[nan if value is None else value for value in astuple(record)] for record in segment.records]
    ends = [] if verdict is None else [[*verdict.scores, verdict.passed, verdict.ticks, verdict.faults]]
    return {
        "counts": np.array([state.population.generation, state.since, state.told_apart], np.int64),
        "genomes": state.population.genomes,
        "scores": state.population.scores,
        "champion": state.champion,
        "rival": state.rival,
        "climbed": state.climbed,
        "champions": np.array(segment.champions, np.float32),
        "records": np.array(records, np.float64),
        "verdict": np.array(ends, np.float64).reshape(-1, len(fields(Verdict)) + 1),
    }


def _segment(arrays: Arrays, course: Course) -> Segment:
    """The segment that these arrays are; ValueError where it is none of the course."""
    generation, since, told_apart = arrays["counts"].tolist()
    champions, weights = arrays["champions"], course.start.shape[1]
    for each in (arrays["genomes"], arrays["champion"], arrays["rival"], champions):
        if each.shape[1] != weights or not np.isfinite(each).all():
            raise ValueError("its genomes are not those of the course")
    state = attempt_state(arrays, generation, since, arrays["climbed"], told_apart)
    verdict = None
    for first, second, passed, ticks, faults in arrays["verdict"].tolist():
        verdict = Verdict(np.array([first, second]), bool(passed), int(ticks), int(faults))
    return Segment(state, tuple(map(_record, arrays["records"].tolist())), tuple(champions), verdict)


def _record(numbers: list[float]) -> Record:
    attempt, generation, best, mean, reevaluated, verdict, ticks, seconds, faults = numbers
    tried, judged = (None if isnan(value) else value for value in (reevaluated, verdict))
    return Record(int(attempt), int(generation), best, mean, tried, judged, int(ticks), seconds, int(faults))
