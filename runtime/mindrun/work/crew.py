"""Workers that are processes: frames to the standard input of a command, answers from its standard output.

A job whose worker ends or answers nonsense is done again by whoever is free; a worker that ended is begun again. A job
that has cost five workers is at fault itself, and so is a place where three workers end without a word.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from queue import Empty, PriorityQueue, Queue
from threading import Lock, Thread
from typing import Any

from mindrun.work import WorkError
from mindrun.work.assignment import Assignment
from mindrun.work.child import Child, NoFrameError, Place
from mindrun.work.executor import Read
from mindrun.work.frame import Frame, FrameError
from mindrun.work.pipes import LostError
from mindrun.work.worker import FAILED, KEPT, LACKS, REFUSED

MAX_LOSSES = 5  # workers that a job may cost
MAX_FALSE_STARTS = 3  # workers in succession that end at a place before they have answered anything
TAKE_SECONDS = 0.2  # to wait for an answer before who asks may look at something else
PATIENCE_TAKES = 50  # in vain, before it is said that no worker has begun yet
END_SECONDS = 5.0  # to wait for workers that were killed
FATAL = "the same job ends whoever does it: memory may run out there, or a procedure or an environment end the process"
MAX_WORDS_CHARACTERS = 2000  # of why a worker has not done a job


@dataclass(order=True, slots=True)
class Job:
    """A job in the queue; those that were lost come first."""

    order: tuple[int, int]
    number: int = field(compare=False)
    data: bytes = field(compare=False)
    read: Read = field(compare=False)
    losses: int = field(compare=False, default=0)


class Crew:
    """Workers at several places, who do the jobs of one assignment; `begin` makes the one at a place.

    `say` is called with a sentence, by `take`, when they are long in coming.
    """

    def __init__(
        self,
        places: Sequence[Place],
        assignment: Assignment,
        begin: Callable[[Place], Child] = Child,
        say: Callable[[str], object] = lambda words: None,
    ) -> None:
        self.assignment = assignment
        self._say, self._takes, self.has_begun = say, 0, False
        self._jobs: PriorityQueue[Job] = PriorityQueue()
        self._answers: Queue[tuple[int, Any] | WorkError] = Queue()
        self.children = [begin(place) for place in places]
        self._lock = Lock()
        self._open, self._left, self._ended = 0, len(places), False
        self._threads = [Thread(target=self._work, args=(child,), daemon=True) for child in self.children]
        for thread in self._threads:
            thread.start()

    @property
    def workers(self) -> int:
        """How many places there are that were not given up."""
        return self._left

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
            self._tell()
            return None
        if isinstance(answer, WorkError):
            raise answer
        self._open -= 1
        return answer

    def _tell(self) -> None:
        """Say once that nobody has begun: others may have to leave their machine first, or no frame may ever come."""
        self._takes += 1
        if self._takes == PATIENCE_TAKES and not self.has_begun:
            names = self.children[0].place.name + (f" and {more} more" if (more := len(self.children) - 1) else "")
            self._say(f"no worker has begun yet ({names}): waiting until mindrun work is ready there (Ctrl-C stops)")

    def close(self) -> None:
        """End all workers, whatever they do."""
        self._ended = True
        for child in self.children:
            child.kill()
        for _ in self._threads:
            self._jobs.put(Job((-1, 0), -1, b"", str))
        for thread in self._threads:
            thread.join(END_SECONDS)

    def _work(self, child: Child) -> None:
        try:
            while self._is_there(child) and (job := self._jobs.get()).number >= 0:
                try:
                    self._answers.put(self._asked(child, job))
                except LostError as why:
                    child.end()
                    if not self._ended:
                        self._lost(child.place, job, f"{why}")
        except Exception as error:  # nobody would hear of it in a thread, and wait for ever
            self._answers.put(WorkError(f"a worker's thread failed: {type(error).__name__}: {error}"))
        finally:
            child.end()

    def _is_there(self, child: Child) -> bool:
        """Begin a worker where there is none; whether that has gone well, not too often in vain."""
        why = ""
        for _ in range(MAX_FALSE_STARTS):
            if self._ended:
                return False
            try:
                child.begin()
            except NoFrameError as error:
                why = f"is none: {error}"
                child.end()
                break
            except LostError as error:
                why = f"ended: {error}"
                child.end()
            else:
                self.has_begun = True
                return True
        self._given_up(child.place, why)
        return False

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

    def _lost(self, place: Place, job: Job, why: str) -> None:
        """Give a job whose worker was lost to others, unless it is at fault itself."""
        job.losses += 1
        if job.losses >= MAX_LOSSES:
            message = f"a job has ended {job.losses} workers, the last at {place.name}: {why}"
            self._answers.put(WorkError(message, FATAL))
            return
        job.order = 0, job.number
        self._jobs.put(job)

    def _given_up(self, place: Place, why: str) -> None:
        """Do without a place; nobody can do anything any more where it was the last."""
        with self._lock:
            self._left -= 1
        if self._left == 0 and not self._ended:
            message = f"no worker is left; the last, at {place.name}, {why}"
            self._answers.put(WorkError(message, "see that the command runs there, and prints nothing of its own"))


def refusal(where: str, answer: Frame) -> WorkError | None:
    """Why the worker there has not done a job, where it says so."""
    message, hint = (str(answer.about.get(each, ""))[:MAX_WORDS_CHARACTERS] for each in ("message", "hint"))
    if answer.kind == REFUSED:
        hint = "install the same wheel there, and the same versions of what it needs"
        return WorkError(f"the worker at {where} is of another build: {message}", hint)
    return WorkError(message, hint) if answer.kind == FAILED else None
