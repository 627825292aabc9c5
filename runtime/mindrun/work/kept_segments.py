"""What attempts ahead of their turn have come to, in a file of the run: a run that goes on has not to do it again.

A frame that says of which run and build it is, then the segments of each attempt, the first first. A stretch that
begins where one of them did has that for its answer, since a segment depends on its stretch alone. A file that is
damaged, or of another run or build, is as none.
"""

from contextlib import suppress
from io import BytesIO
from pathlib import Path

import numpy as np

from mindrun.files.atomic_write import write
from mindrun.files.regular_files import read_whole
from mindrun.train.attempts import AttemptExecutor
from mindrun.train.lesson import Clock
from mindrun.train.lesson_state import AttemptState, Course, begin_attempt
from mindrun.train.rungs import rung_at
from mindrun.train.segment import Joined, Segment, Stretch
from mindrun.work.build import own_build
from mindrun.work.frame import Frame, FrameError, pack, read, unpack
from mindrun.work.stretch_frame import segment_frame, segment_of

NAME, KIND = "ahead", "ahead"
MAX_FILE_BYTES = 1 << 30
SAVE_SECONDS = 2.0  # between two times that the file is written anew, at least
MAX_SAVE_SHARE = 0.05  # of the time that goes into writing it

Chain = list[Joined]  # of an attempt, from rung to rung, each from where that before ends


class KeptSegments:
    """Those of a run, from its file on; attempts that all before have caught up with are forgotten."""

    def __init__(self, folder: Path, identity: str, course: Course) -> None:
        self.path, self.course = folder / NAME, course
        self._about = {"identity": identity, "build": dict(own_build())}
        self.chains: dict[int, Chain] = {}
        with suppress(OSError, FrameError):
            self.chains = self._read(read_whole(self.path, MAX_FILE_BYTES))

    def find(self, stretch: Stretch) -> Segment | None:
        """The segment that begins where a stretch does; None where none is kept."""
        before = begin_attempt(self.course)
        for segment in [] if stretch.cut else self.chains.get(stretch.number, []):
            if is_same(before, stretch.state):
                return segment.whole()
            before = segment.state
        return None

    def put(self, stretch: Stretch, segment: Segment) -> None:
        """Keep what came of a stretch, where all before it has been kept."""
        chain = self.chains.setdefault(stretch.number, [])
        start = chain[-1].state if chain else begin_attempt(self.course)
        if stretch.cut or not is_same(start, stretch.state):
            return
        if chain and rung_at(self.course.lesson, start.population.generation) is None:
            chain[-1].add(segment)
        else:
            chain.append(Joined(segment))

    def forget(self, below: int) -> None:
        """Forget the attempts before one."""
        for number in [number for number in self.chains if number < below]:
            del self.chains[number]

    def save(self) -> None:
        """Write the file, as far as that can be: it spares work, and nothing depends on it."""
        if not any(self.chains.values()):
            self.path.unlink(missing_ok=True)
            return
        frames = [Frame(KIND, self._about)]
        frames += [segment_frame(number, each.whole()) for number, chain in self.chains.items() for each in chain]
        with suppress(OSError, FrameError):
            write(self.path, b"".join(pack(frame) for frame in frames))

    def _read(self, data: bytes) -> dict[int, Chain]:
        stream, chains = BytesIO(data), dict[int, Chain]()
        first = read(stream)
        if first is None or unpack(first) != Frame(KIND, self._about):
            return {}
        while (part := read(stream)) is not None:
            frame = unpack(part)
            number = frame.about.get("number")
            if not isinstance(number, int):
                raise FrameError("it does not say of which attempt it is")
            chain = chains.setdefault(number, [])
            start = chain[-1].state if chain else begin_attempt(self.course)
            stretch = Stretch(number, start)
            chain.append(Joined(segment_of(frame, self.course, stretch, self.course.lesson.generations)))
        return chains


class RememberingExecutor:
    """Does stretches as another does, but for those whose segment has been kept."""

    def __init__(self, stretches: AttemptExecutor, kept: KeptSegments, clock: Clock) -> None:
        self._stretches, self._kept, self._clock = stretches, kept, clock
        self._due = clock() + SAVE_SECONDS
        self._first = self._at = -1  # the attempt that the lesson was at, which checkpoints have; and is at now
        self._ended = set[int]()
        self._asked: dict[int, Stretch] = {}
        self._found: list[tuple[int, Stretch, Segment]] = []

    def has_room(self) -> bool:
        """Whether a worker would wait without another stretch."""
        return self._stretches.has_room()

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch; the first is of the attempt that the lesson is at."""
        if self._first < 0:
            self._first = self._at = stretch.number
        if (segment := self._kept.find(stretch)) is not None:
            self._found.append((job, stretch, segment))
            return
        self._asked[job] = stretch
        self._stretches.submit(job, stretch)

    def take(self) -> tuple[int, Segment] | None:
        """A job and its segment; None where for a while none came."""
        if self._found:
            job, stretch, segment = self._found.pop(0)
            if segment.verdict is not None:
                self._ended.add(stretch.number)
            return job, segment
        if (done := self._stretches.take()) is not None:
            job, segment = done
            self._keep(self._asked.pop(job), segment)
        return done

    def _keep(self, stretch: Stretch, segment: Segment) -> None:
        """Keep a segment, and forget the attempts that the lesson has come past: all up to there have ended."""
        if stretch.number > self._first:
            self._kept.put(stretch, segment)
        if segment.verdict is not None:
            self._ended.add(stretch.number)
        while self._at in self._ended:
            self._at += 1
            self._kept.forget(self._at)
        if (began := self._clock()) >= self._due:
            self._kept.save()
            now = self._clock()
            self._due = now + max(SAVE_SECONDS, (now - began) / MAX_SAVE_SHARE)


def is_same(one: AttemptState, other: AttemptState) -> bool:
    """Whether two states of an attempt are the same."""
    if one is other:
        return True
    return one.population.generation == other.population.generation and all(
        np.array_equal(one_array, other_array)
        for one_array, other_array in (
            (one.population.genomes, other.population.genomes),
            (one.population.scores, other.population.scores),
            (one.champion, other.champion),
        )
    )
