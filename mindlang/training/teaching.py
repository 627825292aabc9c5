"""The beginning and the end of a run of a lesson: what scores its genomes, and what becomes of what was learnt."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from mindrun.engine.engine import procedure_sources
from mindrun.graph.bundle import Bundle, pack
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.terminal.command_line import command_line
from mindrun.train.attempt import Clock
from mindrun.train.attempts import StretchThreads
from mindrun.train.kept_segments import KeptSegments, RememberingExecutor
from mindrun.train.lesson_state import Course, LessonState, is_over
from mindrun.train.population import founder_count
from mindrun.train.run_folder import RunFolder, keep_result, read_result
from mindrun.train.scoring import Scorer, breeding_generator, layouts
from mindrun.train.training import Watch, train

from mindlang.executors import Where, scorer_on
from mindlang.executors.job_scorer import JobScorer
from mindlang.executors.jobs import Assignment, StretchExecutor, WorkError
from mindlang.limits import refuse_too_large, refuse_too_long
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
    side_by_side = min(rollout.workers, learner.attempts)
    refuse_too_large(rollout.on(-(-rollout.workers // side_by_side)), first, learner.layouts, side_by_side)
    refuse_too_long(rollout, (first + learner.population * (lesson.generations - 1)) * learner.layouts)
    return rollout


def make_again(run: RunFolder, rollout: Rollout) -> None:
    """Make a run of a first genome twice; what is not the same again is in the rollout's `notes`."""
    seed = run.manifest.seed
    [genome] = rollout.draw(1, breeding_generator(seed, 0, 0))
    rollout.make_again(genome, int(layouts(seed, 0, 0, 1)[0]))


def assignment_of(run: RunFolder, subject: Subject) -> Assignment:
    """What a worker has to know to do the jobs of a run; MindError where it is too large for a bundle."""
    lesson = run.manifest.lesson
    policy = Policy(subject.graph, run.weights)
    procedures = procedure_sources(subject.graph, subject.folder, lesson.master)
    bundle = pack(Bundle(policy, procedures))
    return Assignment(bundle, lesson.task, lesson.master, run.manifest.learners, folder=subject.folder)


@contextmanager
def workers_of(
    run: RunFolder,
    subject: Subject,
    rollout: Rollout,
    where: Where | None,
    workers: int,
    say: Callable[[str], object],
    clock: Clock,
) -> Iterator[tuple[Scorer, RememberingExecutor | None]]:
    """What scores the genomes of a run, and who does its attempts, where there are several and they go side by side.

    They `say` what they wait for, and are sent away in the end, whatever they do. What they cannot do is a WorkError,
    whose hint says how the run goes on.
    """
    course = run.course(rollout.genome_length)
    with _resumable(run), scorer_on(where, rollout, lambda: assignment_of(run, subject), workers, say) as scorer:
        if (stretches := stretches_of(course, rollout, scorer if where else rollout, clock)) is None:
            yield scorer, None
            return
        kept = KeptSegments(run.folder, run.manifest.identity, course)
        try:
            yield rollout, RememberingExecutor(stretches, kept, clock)
        finally:
            if isinstance(stretches, StretchThreads):
                stretches.close()
            kept.save()


def stretches_of(
    course: Course, rollout: Rollout, scorer: Scorer, clock: Clock
) -> StretchExecutor | StretchThreads | None:
    """Who does several attempts side by side: the workers of a scorer, else threads; None where nobody does.

    Attempts of a lesson that ends with the first that passes go one by one here: the others would be for nothing.
    """
    if course.lesson.learner.attempts == 1:
        return None
    if isinstance(scorer, JobScorer):
        return StretchExecutor(course, scorer.jobs, rollout)
    side_by_side = rollout.workers > 1 and not course.lesson.needs
    return StretchThreads(course, rollout.workers, rollout.on, clock) if side_by_side else None


@contextmanager
def _resumable(run: RunFolder) -> Iterator[None]:
    """Say of work that nobody can do how to go on when somebody can."""
    try:
        yield
    except WorkError as error:
        resume = f"what was saved is intact; to go on: {command_line('mindc', 'train', '--resume', run.folder)}"
        raise WorkError(str(error), "; ".join(filter(None, (error.hint, resume)))) from error


def teach(run: RunFolder, subject: Subject, workers: int, watch: Watch, where: Where | None = None) -> Result | None:
    """Go on with a run to its end, and put what it has taught into the lock; None where `watch` stopped it.

    What came of it, where it has ended before. Its attempts are done `where` it is said, else in so many threads; in
    environments with more than one worker in so many processes.
    """
    if (result := read_result(run.folder)) is not None:
        return result
    rollout = rollout_of(run, subject, workers)
    make_again(run, rollout)
    for note in rollout.notes:
        watch.warn(note)
    processes = workers if workers > 1 else 0  # what was registered in this one is not known in others
    with workers_of(run, subject, rollout, where, processes, watch.warn, watch.clock) as (scorer, executor):
        state = train(run, scorer, watch, executor)
        return finish(run, subject, state, scorer, False, rollout.notes).result if has_ended(run, state) else None


def finish(
    run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, force: bool, notes: Sequence[str] = ()
) -> TeachingResult:
    """Put what a run has taught into the lock, unless what is there does better; with `force` even then.

    The result has the `notes`.

    MindError where nothing was learnt, or the lock is damaged.
    """
    kept = keep(run, subject, state, scorer, force)
    result = result_of(run, subject, state, kept) | {"notes": [*notes]}
    keep_result(run.folder, result)
    return TeachingResult(result, kept)


def has_ended(run: RunFolder, state: LessonState) -> bool:
    """Whether a run has come to its end; it was stopped otherwise."""
    return is_over(run.manifest.lesson, state)
