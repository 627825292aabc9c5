"""The beginning and the end of a run of a lesson: what scores its genomes, and what becomes of what was learnt."""

from dataclasses import dataclass

from mindrun.bundle import Bundle, pack
from mindrun.engine import procedure_sources
from mindrun.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.train.lesson_state import LessonState
from mindrun.train.population import founder_count
from mindrun.train.run_folder import RunFolder, keep_result, read_result
from mindrun.train.training import Watch, train
from mindrun.work.assignment import Assignment

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


def assignment_of(run: RunFolder, subject: Subject) -> Assignment:
    """What a worker has to know to do the jobs of a run; MindError where it is too large for a bundle."""
    lesson = run.manifest.lesson
    policy = Policy(subject.graph, run.weights)
    procedures = procedure_sources(subject.graph, subject.folder, lesson.master)
    return Assignment(pack(Bundle(policy, procedures)), lesson.task, lesson.master, run.manifest.learners)


def teach(run: RunFolder, subject: Subject, workers: int, watch: Watch) -> Result | None:
    """Go on with a run to its end, and put what it has taught into the lock; None where `watch` stopped it.

    What came of it, where it has ended before.
    """
    if (result := read_result(run.folder)) is not None:
        return result
    rollout = rollout_of(run, subject, workers)
    state = train(run, rollout, watch)
    return finish(run, subject, state, rollout, force=False).result if has_ended(run, state) else None


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
