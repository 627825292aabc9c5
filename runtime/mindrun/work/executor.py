"""Who does jobs: in any order, somewhere; and the stretches of a lesson's attempts as such jobs."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from mindrun.train.lesson_state import Course
from mindrun.train.segment import Segment, Stretch
from mindrun.work.assignment import Assignment
from mindrun.work.build import own_build
from mindrun.work.effort import Effort, effort_of
from mindrun.work.frame import Frame, pack
from mindrun.work.stretch_frame import segment_of, stretch_frame

Read = Callable[[Frame], Any]  # what came of a job; FrameError where its answer is nonsense


class JobExecutor(Protocol):
    """Does the jobs of one assignment; one whose worker is lost, or answers nonsense, is done again."""

    @property
    def assignment(self) -> Assignment:
        """What its workers are told."""

    @property
    def workers(self) -> int:
        """How many jobs can be at work at once, as far as is known; it may change."""

    @property
    def has_begun(self) -> bool:
        """Whether a worker has been there by now: before, nobody has done anything."""

    def has_room(self) -> bool:
        """Whether a worker would wait without another job."""

    def submit(self, number: int, data: bytes, read: Read) -> None:
        """Ask for a job, the bytes of a frame."""

    def take(self) -> tuple[int, Any] | None:
        """The number of a job and what came of it; None where for a while none came.

        WorkError where none can come any more.
        """

    def close(self) -> None:
        """End all workers, whatever they do."""


@dataclass(frozen=True, slots=True)
class StretchExecutor:
    """Does the stretches of a course; what its workers count beside their results is counted in `scorer`."""

    course: Course
    jobs: JobExecutor
    scorer: Any = None

    def has_room(self) -> bool:
        """Whether a worker would wait without another stretch."""
        return self.jobs.has_room()

    def submit(self, job: int, stretch: Stretch) -> None:
        """Ask for a stretch."""
        frame = stretch_frame(self.course, stretch, job_about(self.jobs.assignment))

        def came(answer: Frame) -> tuple[Segment, Effort]:
            return segment_of(answer, self.course, stretch), effort_of(answer, self.scorer)

        self.jobs.submit(job, pack(frame), came)

    def take(self) -> tuple[int, Segment] | None:
        """A job and its segment; None where for a while none came."""
        if (done := self.jobs.take()) is None:
            return None
        job, (segment, effort) = done
        effort.count_in(self.scorer)
        return job, segment


def job_about(assignment: Assignment) -> dict[str, Any]:
    """What every job says of where it comes from."""
    return {"build": dict(own_build()), "assignment": assignment.name}
