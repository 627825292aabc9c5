"""A worker: answers frames with frames. A job is a pure function of what it says and of its assignment."""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mindrun.errors import MindError
from mindrun.train.scoring import Scorer
from mindrun.train.segment import advance
from mindrun.work.assignment import KIND as ASSIGNMENT
from mindrun.work.assignment import Assignment, assignment_of
from mindrun.work.build import difference, own_build
from mindrun.work.effort import Effort, tally_of
from mindrun.work.frame import DIGEST_BYTES, Frame, FrameError, pack, unpack
from mindrun.work.score_frame import SCORE, scores_frame, work_of
from mindrun.work.stretch_frame import ADVANCE, segment_frame, stretch_of

READY, ALIVE = "ready", "alive"  # what is said without being asked
KEPT, LACKS, REFUSED, FAILED = "kept", "lacks", "refused", "failed"  # answers that are no results
KEPT_ASSIGNMENTS = 4  # of which a worker keeps what scores them
MAX_SILENT_SECONDS = 86_400  # that a worker may ask for

Clock = Callable[[], float]


class Worker:
    """Keeps what scores the assignments that it was told last; `make` is how an assignment becomes such a scorer.

    `drop` is told of one that is kept no longer.
    """

    def __init__(
        self, make: Callable[[Assignment], Any], clock: Clock, drop: Callable[[Any], None] = lambda scorer: None
    ) -> None:
        self._make, self._clock, self._drop = make, clock, drop
        self._known: OrderedDict[str, Any] = OrderedDict()
        self.at_work: Any = None  # what scores the job at work

    def answer(self, data: bytes) -> bytes:
        """The answer to a job; whatever is wrong with it is an answer, too."""
        try:
            return answer_to(data, self._answer(unpack(data)))
        except FrameError as error:
            return answer_to(data, failure(f"a job is damaged: {error}"))
        except MindError as error:
            return answer_to(data, failure(str(error), error.hint))
        except Exception as error:
            said = f"a job failed: {type(error).__name__}: {error}"
            return answer_to(data, failure(f"{said:.1000}"))
        finally:
            self.at_work = None

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
            self._drop(self._known.popitem(last=False)[1])

    def _done(self, frame: Frame, scorer: Scorer) -> Frame:
        self.at_work, before, began = scorer, tally_of(scorer), self._clock()
        if frame.kind == ADVANCE:
            course, stretch = stretch_of(frame)
            if course.start.shape[1] != scorer.genome_length:
                raise FrameError(f"its genomes have no {scorer.genome_length} weights")
            done = segment_frame(stretch.number, advance(course, scorer, stretch, self._clock))
        elif frame.kind == SCORE:
            done = scores_frame(scorer.score(*work_of(frame, scorer.genome_length)))
        else:
            raise FrameError(f"nobody knows what {frame.kind!r:.40} is")
        effort = Effort(max(0.0, self._clock() - began), tally_of(scorer) - before)
        return replace(done, about={**done.about, **effort.about})


def answer_to(data: bytes, frame: Frame) -> bytes:
    """An answer as bytes, which says to which job it is one: by the SHA-256 at the job's end."""
    return pack(replace(frame, about={**frame.about, "of": data[-DIGEST_BYTES:].hex()}))


def failure(message: str, hint: str = "") -> Frame:
    """Why a job was not done."""
    return Frame(FAILED, {"message": message, "hint": hint})
