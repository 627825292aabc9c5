"""Workers that are processes: frames to the standard input of a command, answers from its standard output.

A job whose worker ends or answers nonsense is done again by whoever is free; a worker that ended is begun again. A job
that has cost five workers is at fault itself, and so is a place where three workers end without a word.
"""

import subprocess
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from queue import Empty, PriorityQueue, Queue
from threading import Lock, Thread
from typing import IO, Any

from mindrun.errors import MindError
from mindrun.work import WorkError
from mindrun.work.assignment import Assignment
from mindrun.work.executor import Read
from mindrun.work.frame import Frame, FrameError, read, unpack
from mindrun.work.worker import FAILED, KEPT, LACKS, REFUSED

MAX_LOSSES = 5  # workers that a job may cost
MAX_FALSE_STARTS = 3  # workers in succession that end at a place before they have answered anything
TAKE_SECONDS = 0.2  # to wait for an answer before who asks may look at something else
SHOWN_CHARACTERS = 300  # of what a worker said last
MAX_WORDS_CHARACTERS = 2000  # of why a worker has not done a job


@dataclass(frozen=True, slots=True)
class Place:
    """Where a worker runs: what to call it, and the command that is one."""

    name: str
    command: Sequence[str]


@dataclass(order=True, slots=True)
class Job:
    """A job in the queue; those that were lost come first."""

    order: tuple[int, int]
    number: int = field(compare=False)
    data: bytes = field(compare=False)
    read: Read = field(compare=False)
    losses: int = field(compare=False, default=0)


class LostError(MindError):
    """A worker has ended, or answers nonsense."""


class Child:
    """A worker's process, which is begun when it is first asked."""

    def __init__(self, place: Place) -> None:
        self.place = place
        self.process: subprocess.Popen[bytes] | None = None
        self.has_answered = False
        self._said: IO[bytes] | None = None

    def ask(self, data: bytes) -> Frame:
        """The answer to a frame; LostError where there is none."""
        try:
            process = self.process or self._begin()
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(data)
            process.stdin.flush()
            answer = read(process.stdout)
            if answer is None:
                raise LostError(self._last_words() or "it ended")
            frame = unpack(answer)
            self.has_answered = True
            return frame
        except FrameError as error:
            raise LostError(f"its answer is no frame: {error}") from error
        except OSError as error:
            raise LostError(self._last_words() or f"{error.strerror}") from error

    def end(self) -> None:
        """End the process, whatever it does."""
        process, self.process = self.process, None
        if process is not None:
            with suppress(OSError):
                process.kill()
            for stream in (process.stdin, process.stdout, self._said):
                with suppress(OSError):  # what is left to be written has nobody to go to
                    stream.close()  # type: ignore[union-attr]
            process.wait()

    def _begin(self) -> subprocess.Popen[bytes]:
        # A session of its own: Ctrl-C at the terminal is for who asks, who lets the work go on to be saved.
        self.has_answered = False
        self._said = tempfile.TemporaryFile()  # noqa: SIM115 - for as long as the process
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(
            self.place.command, stdin=pipe, stdout=pipe, stderr=self._said, start_new_session=True
        )
        return self.process

    def _last_words(self) -> str:
        """The last line that it wrote on standard error."""
        if self._said is None or self._said.closed:
            return ""
        with suppress(OSError, subprocess.TimeoutExpired):
            if self.process is not None:
                self.process.wait(1)
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").strip().splitlines()
        return lines[-1][:SHOWN_CHARACTERS] if lines else ""


class Crew:
    """Workers at several places, who do the jobs of one assignment."""

    def __init__(self, places: Sequence[Place], assignment: Assignment) -> None:
        self.assignment = assignment
        self._jobs: PriorityQueue[Job] = PriorityQueue()
        self._answers: Queue[tuple[int, Any] | WorkError] = Queue()
        self.children = [Child(place) for place in places]
        self._lock = Lock()
        self._open, self._left, self._ended = 0, len(places), False
        self._threads = [Thread(target=self._work, args=(child,), daemon=True) for child in self.children]
        for thread in self._threads:
            thread.start()

    def has_room(self) -> bool:
        """Whether a worker would wait without another job."""
        return self._open < self._left

    def submit(self, number: int, data: bytes, read: Read) -> None:
        """Ask for a job, the bytes of a frame; `read` says what its answer means."""
        self._open += 1
        self._jobs.put(Job((1, number), number, data, read))

    def take(self) -> tuple[int, Any] | None:
        """A job and what came of it; None where for a while none came. WorkError where none can come any more."""
        try:
            answer = self._answers.get(timeout=TAKE_SECONDS)
        except Empty:
            return None
        if isinstance(answer, WorkError):
            raise answer
        self._open -= 1
        return answer

    def close(self) -> None:
        """End all workers, whatever they do."""
        self._ended = True
        for child in self.children:
            child.end()
        for _ in self._threads:
            self._jobs.put(Job((-1, 0), -1, b"", str))

    def _work(self, child: Child) -> None:
        false_starts = 0
        while not self._ended and (job := self._jobs.get()).number >= 0:
            try:
                self._answers.put(self._asked(child, job))
                false_starts = 0
            except LostError as why:
                false_starts = 0 if child.has_answered else false_starts + 1
                job.losses += child.has_answered
                child.end()
                if self._ended or not self._goes_on(child.place, job, str(why), false_starts):
                    return
            except Exception as error:  # nobody would hear of it in a thread, and wait for ever
                self._answers.put(WorkError(f"a worker's thread failed: {type(error).__name__}: {error}"))
                return

    def _asked(self, child: Child, job: Job) -> tuple[int, Any] | WorkError:
        """What came of a job, from a worker that may have to be told the assignment first."""
        answer = child.ask(job.data)
        if answer.kind == LACKS:
            told = child.ask(self.assignment.packed)
            answer = child.ask(job.data) if told.kind == KEPT else told
        if (error := refusal(child.place.name, answer)) is not None:
            return error
        try:
            return job.number, job.read(answer)
        except FrameError as error:
            raise LostError(f"its answer is nonsense: {error}") from error

    def _goes_on(self, place: Place, job: Job, why: str, false_starts: int) -> bool:
        """Give a lost job to others; whether another worker is begun at the place."""
        if job.losses >= MAX_LOSSES:
            message = f"a job has ended {job.losses} workers, the last at {place.name}: {why}"
            self._answers.put(WorkError(message, "what is saved is intact: go on with --resume"))
            return False
        job.order = 0, job.number
        self._jobs.put(job)
        if false_starts < MAX_FALSE_STARTS:
            return True
        with self._lock:
            self._left -= 1
        if self._left == 0:
            message = f"no worker is left; the last, at {place.name}, ended: {why}"
            self._answers.put(WorkError(message, "see that the command runs there, then go on with --resume"))
        return False


def refusal(where: str, answer: Frame) -> WorkError | None:
    """Why the worker there has not done a job, where it says so."""
    message, hint = (str(answer.about.get(each, ""))[:MAX_WORDS_CHARACTERS] for each in ("message", "hint"))
    if answer.kind == REFUSED:
        hint = "install the same wheel there, and the same versions of what it needs"
        return WorkError(f"the worker at {where} is of another build: {message}", hint)
    return WorkError(message, hint) if answer.kind == FAILED else None
