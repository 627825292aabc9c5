"""The beginning and the end of a run of a lesson: what scores its genomes, and what becomes of what was learnt."""

from dataclasses import dataclass

from mindrun.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.train.lesson_state import LessonState
from mindrun.train.population import founder_count
from mindrun.train.run_folder import RunFolder, keep_result

from mindlang.resource_limits import refuse_too_large, refuse_too_long
from mindlang.training.lock_update import Kept, keep
from mindlang.training.results import Result, result_of
from mindlang.training.subject import Subject


@dataclass(frozen=True, slots=True)
class TeachingResult:
    """What came of a run that has ended."""

    result: Result
    kept: Kept


def rollout_of(run: RunFolder, subject: Subject, workers: int) -> Rollout:
    """What scores the genomes of a run; MindError where memory or a year would not suffice."""
    lesson = run.manifest.lesson
    rollout = rollout_for(
        Policy(subject.graph, run.weights),
        lesson.task,
        lesson.master,
        run.manifest.learners,
        procedures=subject.folder,
        workers=workers,
    )
    learner = lesson.learner
    first = founder_count(learner)
    refuse_too_large(rollout, first, learner.layouts)
    refuse_too_long(rollout, (first + learner.population * (lesson.generations - 1)) * learner.layouts)
    return rollout


def finish(run: RunFolder, subject: Subject, state: LessonState, rollout: Rollout, force: bool) -> TeachingResult:
    """Put what a run has taught into the lock, unless what is there does better; with `force` even then.

    MindError where nothing was learnt, or the lock is damaged.
    """
    kept = keep(run, subject, state, rollout, force)
    result = result_of(run, state, kept)
    keep_result(run.folder, result)
    return TeachingResult(result, kept)


def has_ended(run: RunFolder, state: LessonState) -> bool:
    """Whether a run has come to its end; it was stopped otherwise."""
    return state.attempt == run.manifest.lesson.learner.attempts
