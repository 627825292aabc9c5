"""Weights that a lesson has taught go to the lock, unless those that are there do better."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.weights import owner_of, parts
from mindrun.kinds.registry import phrase
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.attempt import VERDICT_LAYOUTS, has_needed, of_halves, verdict_layouts
from mindrun.train.lesson_state import LessonState
from mindrun.train.population import Genomes
from mindrun.train.run_folder import WEIGHTS, RunFolder, keep_failure
from mindrun.train.scoring import Purpose, Scorer, Seeds, is_one_world, layouts, mark, measured

from mindlang.compiler.diagnostic import listed
from mindlang.lock import LockError, Taught, read_lock
from mindlang.lock.blobs import record
from mindlang.lock.status import key_of, trained_weights
from mindlang.lock.world_facts import Worlds
from mindlang.number_format import short_score
from mindlang.training.retention import Retention, retention_table, retentions
from mindlang.training.subject import Subject

COMPARED_LAYOUTS = 50  # common to the weights that a lock has and to the new ones, and to nothing else


@dataclass(frozen=True, slots=True)
class WeightsComparison:
    """The mean scores of the weights that stood in the lock and of the new ones, on the same fresh layouts."""

    old: float
    new: float

    @property
    def is_worse(self) -> bool:
        return self.new < self.old

    def __str__(self) -> str:
        """A sentence that says why the old weights stay."""
        return (
            f"the weights that were there do better: {short_score(self.old)} against {short_score(self.new)} "
            f"on the same {COMPARED_LAYOUTS} fresh layouts"
        )


@dataclass(frozen=True, slots=True)
class Kept:
    """The end of a lesson: whether the new weights are in the lock, how those that were there compare, if any, and what
    became of earlier lessons.
    """

    is_new: bool
    comparison: WeightsComparison | None
    earlier: Sequence[Retention] = ()


def keep(run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, force: bool, workers: int) -> Kept:
    """Put what was learnt into the lock, or with `force` even where it is worse than what is there.

    RunError where nothing was learnt, not what the lesson needs, or, without `force`, at the cost of what it keeps: the
    run's folder says so. LockError where the lock cannot be read or written.
    """
    try:
        _refuse_nothing(run, state, scorer)
        _refuse_failed(run, state, scorer)
        return _put(run, subject, state, scorer, force, workers)
    except RunError as error:
        keep_failure(run.folder, str(error))
        raise


def _put(run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, force: bool, workers: int) -> Kept:
    """What has been learnt against what is in the lock, and the better of both there."""
    lesson, new, found = run.manifest.lesson, state.kept[0], None
    old = genome_there(subject, lesson, run.manifest.learners)
    if old is not None and not np.array_equal(old, new):
        found = compare_genomes(run, scorer, np.stack([old, new]))
        seeds = verdict_layouts(run.manifest.seed, lesson.generations)  # on which the new weights have what is needed
        stays = not force and found.is_worse
        if stays and (not lesson.needs or has_needed(lesson, scorer.task, scorer.score(old[None], seeds))):
            if subject.is_due(declared(subject, lesson)):
                _record(run, subject, state, scorer, old, found.old)
            return Kept(False, found)
    earlier = retentions(run, subject, new, workers)
    if not force:
        _refuse_forgotten(run, earlier)
    _record(run, subject, state, scorer, new, state.reevaluated)
    return Kept(True, found, earlier)


def _refuse_nothing(run: RunFolder, state: LessonState, scorer: Scorer) -> None:
    """RunError where a lesson has taught nothing: the best had no score in the end, or all scores were the same."""
    lesson = run.manifest.lesson
    if not isfinite(state.reevaluated):
        seeds = verdict_layouts(run.manifest.seed, lesson.generations)
        faulty = mark(scorer, state.kept, seeds).faults
        where = "in its one world" if is_one_world(scorer) else f"on {faulty} of {len(seeds)} fresh layouts"
        why = f"{where} a reward or a command of the best genome was no finite number"
        hint = f"look at the rewards of the task {lesson.task}: mindc lint says what is divided by what can be 0"
    elif not state.told_apart:
        why = f"every genome of a generation scored the same, {short_score(state.best)} at best"
        hint = (
            f"look at the rewards of the task {lesson.task}: are they ever paid, and does what {lesson.skill} "
            "sends make a difference? mindc run shows what each line pays"
        )
    else:
        return
    raise RunError(f"{lesson.skill} has learnt nothing: {why}; the lock stays as it is", hint)


def _refuse_failed(run: RunFolder, state: LessonState, scorer: Scorer) -> None:
    """RunError where no attempt has met what its lesson needs: nothing is to be taught on top of that."""
    lesson = run.manifest.lesson
    if not lesson.needs or state.passed.any():
        return
    which = "its only attempt" if state.attempt == 1 else f"the best of {state.attempt} attempts"
    needed, reached = listed(map(str, lesson.needs), "and"), "scored " + " and ".join(map(short_score, state.verdict))
    if others := [need for need in lesson.needs if need.measure != "score"]:
        tried = scorer.score(state.kept, verdict_layouts(run.manifest.seed, lesson.generations))
        for need, (one, other) in ((need, of_halves(measured(need, scorer.task, tried))) for need in others):
            often = f"came to {one:g} and {other:g} {phrase(need.event)}" if need.event else ""
            reached += f", and {often or f'succeeded in {one:.0%} and {other:.0%} of the runs'}"
    raise RunError(
        f"{lesson.skill} has failed its lesson, which needs {needed} on two sets of fresh layouts: {which} "
        f"{reached}; the lock stays as it is, and nothing is taught on top of it",
        f"try more --attempts, more generations or another --seed; what it has learnt is in {run.folder / WEIGHTS}",
    )


def _refuse_forgotten(run: RunFolder, earlier: Sequence[Retention]) -> None:
    """RunError where less is left of an earlier lesson than the one that has ended keeps."""
    lesson, share = run.manifest.lesson, run.manifest.lesson.learner.keeps
    lost = [each.lesson.name for each in earlier if not each.is_kept(share)]
    if not share or not lost:
        return
    failed = (
        f"{lesson.skill} has failed its lesson, which keeps {100 * share:g}% of what earlier ones scored, and less "
        f"is left of {listed(lost, 'and')}; the lock stays as it is"
    )
    resume = command_line("mindc", "train", "--resume", run.folder, "--force")
    raise RunError(
        "\n".join([failed, *retention_table(earlier)]),
        f"what it has learnt is in {run.folder / WEIGHTS}; to take it: {resume}; else try another --seed, or a smaller "
        "mutation",
    )


def compare_genomes(run: RunFolder, scorer: Scorer, genomes: Genomes) -> WeightsComparison:
    """Two genomes on layouts that neither has seen: the mean of each; -inf where something was not finite."""
    seeds = layouts(run.manifest.seed, 0, run.manifest.lesson.generations, COMPARED_LAYOUTS, Purpose.COMPARISON)
    old, new = mark(scorer, genomes, seeds, run.manifest.lesson.learner.lowest).scores
    return WeightsComparison(float(old), float(new))


def needed_figures(lesson: Lesson, scorer: Scorer, genome: Genomes, seeds: Seeds) -> tuple[float | None, str]:
    """The share of runs on these seeds in which a genome succeeds, and how often events happen in their mean.

    Each as a lock has it; None and "" where its lesson does not need any.
    """
    needs = [need for need in lesson.needs if need.measure != "score"]
    if not needs:
        return None, ""
    results = scorer.score(genome[None], seeds)
    reached = [(need.event, float(measured(need, scorer.task, results).mean())) for need in needs]
    success = next((share for event, share in reached if not event), None)
    return success, ", ".join(f"{times} {phrase(event)}" for event, times in reached if event)


def genome_there(subject: Subject, lesson: Lesson, learners: Sequence[str]) -> Genomes | None:
    """The weights of learners in the lock to which a lesson goes; None where not all have some that fit."""
    try:
        known, _ = trained_weights(subject.graph, read_lock(subject.keep_path(lesson)), learners)
    except LockError:  # their file is gone or damaged
        return None
    return np.concatenate([known[skill] for skill in learners]) if known.keys() >= {*learners} else None


def _record(
    run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, genome: Genomes, score: float
) -> None:
    lesson, learners, seed = run.manifest.lesson, run.manifest.learners, run.manifest.seed
    asked = declared(subject, lesson)
    needed = needed_figures(asked, scorer, genome, verdict_layouts(seed, lesson.generations)[VERDICT_LAYOUTS:])
    where, population = (lesson.task, lesson.master, lesson.with_subskills), lesson.learner.population
    taught = Taught(*where, state.kept_after, population, seed, score, lesson.number, lesson.curriculum, *needed)
    begun_with = {
        skill: subject.lock[skill]
        for skill in learners
        if skill in run.weights and not lesson.from_scratch and not (lesson.starts_from and skill == lesson.skill)
    }
    learnt = parts(subject.graph, learners, genome)
    world = Worlds(subject.graph, subject.folder).of(asked)
    begun = subject.lock.get(owner_of(subject.graph, lesson.starts_from))
    origins = {lesson.skill: (lesson.starts_from, begun.weights)} if begun else {}
    record(subject.keep_path(lesson), subject.graph, learnt, taught, run.weights, world, begun_with, origins)


def declared(subject: Subject, lesson: Lesson) -> Lesson:
    """The lesson as the source has it: what the command line said of it once is no reason to teach it again."""
    alike = (
        each
        for each in subject.graph.lessons
        if (each.skill, each.curriculum, key_of(each)) == (lesson.skill, lesson.curriculum, key_of(lesson))
        and each.number == (lesson.number or each.number)
    )
    return next(alike, lesson)
