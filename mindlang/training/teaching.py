"""A run of a lesson from beginning to end: the workers that score its genomes, and its result as data and in words."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any

from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.terminal.command_line import command_line
from mindrun.train.attempt import Clock
from mindrun.train.attempts import AttemptExecutor, StretchThreads
from mindrun.train.kept_segments import KeptSegments, RememberingExecutor
from mindrun.train.lesson_state import LessonState, is_over
from mindrun.train.population import founder_count
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import WEIGHTS, RunFolder, keep_result, read_result
from mindrun.train.scoring import Scorer, breeding_generator, layouts
from mindrun.train.training import Watch, train

from mindlang.executors import Where, scorer_on
from mindlang.executors.jobs import JobScorer, StretchExecutor, WorkError, assignment_of
from mindlang.limits import refuse_too_large, refuse_too_long
from mindlang.lock.blobs import digest
from mindlang.number_format import duration, finite, short_score, speed
from mindlang.training.lock_update import Kept, keep
from mindlang.training.remarks import remarks
from mindlang.training.retention import retention_table
from mindlang.training.standstill import idle_note, idle_ticks
from mindlang.training.subject import Subject

Result = dict[str, Any]


def rollout_of(run: RunFolder, subject: Subject, workers: int) -> Rollout:
    """The rollout that scores the genomes of a run; MindError where memory or a year would not suffice."""
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
    """The scorer of a run's genomes, and the executor of its attempts where there are several that go side by side.

    They `say` what they wait for, and are sent away in the end, whatever they do. What they cannot do is a WorkError,
    whose hint says how the run goes on.
    """
    lesson, policy = run.manifest.lesson, Policy(subject.graph, run.weights)
    cast = lesson.task, lesson.master, subject.folder, run.manifest.learners
    # Attempts of a lesson that ends with the first that passes go one by one here: the others would be for nothing.
    has_several, goes_on = lesson.learner.attempts > 1, rollout.workers > 1 and not lesson.needs
    scored = scorer_on(where, rollout, partial(assignment_of, policy, *cast), workers, say)
    try:
        with scored as scorer, ExitStack() as end:
            course = run.course(rollout.genome_length)
            stretches: AttemptExecutor
            if has_several and where and isinstance(scorer, JobScorer):
                stretches = StretchExecutor(course, scorer.jobs, rollout)
            elif has_several and goes_on and not where:
                stretches = threads = StretchThreads(course, rollout.workers, rollout.on, clock)
                end.callback(threads.close)
            else:
                yield scorer, None
                return
            kept = KeptSegments(run.folder, run.manifest.identity, course)
            end.callback(kept.save)
            yield rollout, RememberingExecutor(stretches, kept, clock)
    except WorkError as error:
        resume = f"what was saved is intact; to go on: {command_line('mindc', 'train', '--resume', run.folder)}"
        raise WorkError(str(error), "; ".join(filter(None, (error.hint, resume)))) from error


def teach(run: RunFolder, subject: Subject, workers: int, watch: Watch, where: Where | None = None) -> Result | None:
    """Go on with a run to its end, and put what it has taught into the lock; None where `watch` stopped it.

    A run that has ended before gives its result. Its attempts are done `where` it is said, else in so many threads; in
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
        if not is_over(run.manifest.lesson, state):
            return None
        return finish(run, subject, state, scorer, False, workers, rollout.notes)[0]


def finish(
    run: RunFolder,
    subject: Subject,
    state: LessonState,
    scorer: Scorer,
    force: bool,
    workers: int,
    notes: Sequence[str],
) -> tuple[Result, Kept]:
    """Put what a run has taught into the lock, unless what is there does better; with `force` even then.

    The result has the `notes`, and more on what was learnt. MindError where nothing was, or the lock is damaged.
    """
    kept = keep(run, subject, state, scorer, force, workers)
    result = result_of(run, subject, state, kept)
    more = remarks(run, subject, state.kept[0]) if kept.is_new else []
    result["notes"] = [*notes, *more, *result["notes"]]
    keep_result(run.folder, result)
    return result, kept


def opening(run: RunFolder) -> str:
    """A sentence that says what is about to be taught."""
    lesson = run.manifest.lesson
    known = set(run.manifest.learners) <= set(run.weights)
    origin = f"the weights of {lesson.starts_from}" if lesson.starts_from else "its weights"
    start = "from scratch" if lesson.from_scratch or not known else f"from {origin}"
    where = f"on {lesson.task}" + (f" under {lesson.master}" if lesson.master != lesson.skill else "")
    who = f"{lesson.skill} with its subskills" if lesson.with_subskills else lesson.skill
    return f"{who} {where} {start}, seed {run.manifest.seed}, in {run.folder}"


def result_of(run: RunFolder, subject: Subject, state: LessonState, kept: Kept) -> Result:
    """A finished run as plain data; `weights` has the SHA-256 of what was learnt of each skill.

    `kept` says whether that is in the lock now. Where this had weights before, `compared` are their score and that of
    the new ones on common fresh layouts; `earlier` are lessons of which it has changed skills, before and after.
    `idle_ticks` came after the last gain; `notes` say so where they are many.
    """
    lesson, records = run.manifest.lesson, read_progress(run.folder)
    learnt = parts(subject.graph, run.manifest.learners, state.kept[0])
    return {
        "lesson": run.manifest.name,
        "curriculum": lesson.curriculum,
        "skill": lesson.skill,
        "task": lesson.task,
        "master": lesson.master,
        "generations": lesson.generations,
        "bred": state.generations,
        "population": lesson.learner.population,
        "attempts": state.attempt,
        "seed": run.manifest.seed,
        "best": state.best,
        "reevaluated": state.reevaluated,
        "ticks": state.ticks,
        "idle_ticks": idle_ticks(records),
        "seconds": round(state.seconds, 3),
        "ticks_per_second": round(state.ticks / max(state.seconds, 1e-9)),
        "faults": state.faults,
        "verdicts": [finite(verdict) for verdict in state.verdicts[:, 1]],
        "weights": {skill: digest(weights) for skill, weights in learnt.items()},
        "kept": kept.is_new,
        "compared": [finite(score) for score in (kept.comparison.old, kept.comparison.new)]
        if kept.comparison
        else None,
        "earlier": [
            {"lesson": each.lesson.name, "before": each.before, "after": finite(each.after)} for each in kept.earlier
        ],
        "run": str(run.folder),
        "notes": [*filter(None, [idle_note(records)])],
    }


def outcome(run: RunFolder, result: Result, kept: Kept, lock: str) -> list[str]:
    """Lines that say what was learnt, what is in the lock now, and where the new weights are if they are not there."""
    generations = "1 generation" if result["bred"] == 1 else f"{result['bred']} generations"
    if result["attempts"] > 1:
        generations += f" in {result['attempts']} attempts"
    lowest = run.manifest.lesson.learner.lowest
    where = "fresh layouts" if lowest == 1 else f"the lowest {100 * lowest:g}% of fresh layouts"
    learnt = (
        f"{result['skill']} has learnt: {short_score(result['reevaluated'])} on {where} after "
        f"{generations}, in {duration(result['seconds'])} at {speed(result)}"
    )
    if kept.is_new:
        worse = kept.comparison is not None and kept.comparison.is_worse
        return [
            f"{learnt}; weights in {lock}",
            *[f"but {kept.comparison}"] * worse,
            *(retention_table(kept.earlier) if kept.earlier else []),
        ]
    stay = f"{kept.comparison}, and stay in {lock}"
    return [learnt, stay, f"the new ones: {run.folder / WEIGHTS}; --force puts them there"]
