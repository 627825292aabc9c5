"""A worker: answers frames with frames. A job is a pure function of what it says and of its assignment."""

from collections import OrderedDict
from collections.abc import Callable
from typing import IO, Any

from mindrun.errors import MindError
from mindrun.train.attempts import advance
from mindrun.train.scoring import Scorer
from mindrun.work.assignment import KIND as ASSIGNMENT
from mindrun.work.assignment import Assignment, assignment_of
from mindrun.work.build import difference, own_build
from mindrun.work.frame import Frame, FrameError, pack, read, unpack
from mindrun.work.score_frame import SCORE, scores_frame, work_of
from mindrun.work.stretch_frame import ADVANCE, segment_frame, stretch_of

KEPT, LACKS, REFUSED, FAILED = "kept", "lacks", "refused", "failed"  # answers that are no results
KEPT_ASSIGNMENTS = 4  # of which a worker keeps what scores them

Clock = Callable[[], float]


class Worker:
    """Keeps what scores the assignments that it was told last; `make` is how an assignment becomes such a scorer."""

    def __init__(self, make: Callable[[Assignment], Any], clock: Clock) -> None:
        self._make, self._clock = make, clock
        self._known: OrderedDict[str, Any] = OrderedDict()

    def answer(self, data: bytes) -> bytes:
        """The answer to a job; whatever is wrong with it is an answer, too."""
        try:
            return pack(self._answer(unpack(data)))
        except FrameError as error:
            return pack(Frame(FAILED, {"message": f"a job is damaged: {error}", "hint": ""}))
        except MindError as error:
            return pack(Frame(FAILED, {"message": str(error), "hint": error.hint}))
        except Exception as error:
            said = f"a job failed: {type(error).__name__}: {error}"
            return pack(Frame(FAILED, {"message": f"{said:.1000}", "hint": ""}))

    def _answer(self, frame: Frame) -> Frame:
        if differs := difference(frame.about.get("build"), own_build()) if frame.kind != ASSIGNMENT else "":
            return Frame(REFUSED, {"message": differs})
        if frame.kind == ASSIGNMENT:
            self._keep(assignment_of(frame))
            return Frame(KEPT)
        name = frame.about.get("assignment")
        if not isinstance(name, str) or name not in self._known:
            return Frame(LACKS)
        self._known.move_to_end(name)
        return self._done(frame, self._known[name])

    def _keep(self, assignment: Assignment) -> None:
        self._known[assignment.name] = self._make(assignment)
        while len(self._known) > KEPT_ASSIGNMENTS:
            self._known.popitem(last=False)

    def _done(self, frame: Frame, scorer: Scorer) -> Frame:
        if frame.kind == ADVANCE:
            course, stretch = stretch_of(frame)
            if course.start.shape[1] != scorer.genome_length:
                raise FrameError(f"its genomes have no {scorer.genome_length} weights")
            return segment_frame(stretch.number, advance(course, scorer, stretch, self._clock))
        if frame.kind == SCORE:
            return scores_frame(scorer.score(*work_of(frame)))
        raise FrameError(f"nobody knows what {frame.kind!r:.40} is")


def serve(worker: Worker, requests: IO[bytes], answers: IO[bytes]) -> None:
    """Answer frame after frame until no more come; FrameError where something else comes."""
    while (data := read(requests)) is not None:
        answers.write(worker.answer(data))
        answers.flush()
