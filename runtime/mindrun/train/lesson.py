"""One lesson: generation after generation, and the weights kept are those that do best on layouts never seen."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import inf

import numpy as np

from mindrun.graph import Lesson
from mindrun.learners import Learner
from mindrun.train.ask_and_tell import ask, kept_count, tell
from mindrun.train.lesson_state import Course, LessonState, Record
from mindrun.train.population import Scores, nobody, order
from mindrun.train.rungs import is_behind, not_climbed, rung_at
from mindrun.train.scoring import Scorer, mark
from mindrun.train.seeds import Purpose, Seeds, breeding_generator, layouts

REEVALUATION_GENERATIONS = 10  # between two re-evaluations
REEVALUATED_CANDIDATES = 4  # of a generation, that are re-evaluated beside the champion
REEVALUATION_LAYOUTS = 16  # layouts of a re-evaluation of so many candidates
VERDICT_LAYOUTS = 50  # layouts on which attempts are compared, and as many others on which the best is reported

Clock = Callable[[], float]


def teach(course: Course, scorer: Scorer, state: LessonState, clock: Clock) -> Iterator[tuple[LessonState, Record]]:
    """The state and the record after each generation that is left; who iterates may stop after any of them."""
    while state.attempt < course.lesson.learner.attempts:
        began = clock()
        state, record = generation(course, scorer, state)
        seconds = clock() - began
        state = replace(state, seconds=state.seconds + seconds)
        yield state, replace(record, seconds=seconds)


def generation(course: Course, scorer: Scorer, state: LessonState) -> tuple[LessonState, Record]:
    """One generation: bred, scored, and every now and then its best tried on fresh layouts."""
    learner, key = course.lesson.learner, (course.seed, state.attempt, state.population.generation)
    genomes = ask(state.population, learner, course.start, scorer.draw, breeding_generator(*key))
    marks = mark(scorer, genomes, layouts(*key, learner.layouts))
    population = tell(state.population, learner, course.start, genomes, marks.scores)
    now = replace(
        state,
        population=population,
        best=max(state.best, float(marks.scores.max())),
        generations=state.generations + 1,
        ticks=state.ticks + marks.ticks,
        faults=state.faults + marks.faults,
        told_apart=state.told_apart or are_different(marks.scores),
    )
    number, reevaluated, verdict = population.generation, None, None
    rung = rung_at(course.lesson, number)
    if number == 1 or number % REEVALUATION_GENERATIONS == 0 or rung is not None or has_ended(course.lesson, now):
        now, reevaluated = try_again(now, scorer, layouts(*key, fresh_count(learner), Purpose.REEVALUATION))
    if rung is not None:
        now = climb(now, scorer, rung, layouts(course.seed, 0, number, VERDICT_LAYOUTS, Purpose.RUNG))
    if has_ended(course.lesson, now):
        now, verdict = judge(course, scorer, now)
    ticks, faults = now.ticks - state.ticks, now.faults - state.faults
    best, mean = float(marks.scores.max()), _mean(marks.scores)
    return now, Record(state.attempt + 1, number, best, mean, reevaluated, verdict, ticks, 0.0, faults)


def has_ended(lesson: Lesson, state: LessonState) -> bool:
    """Whether an attempt has had all its generations, has not become better for too many, or falls behind others."""
    generation = state.population.generation
    rung = rung_at(lesson, generation)
    return (
        generation == lesson.generations
        or 0 < lesson.learner.patience <= generation - state.since
        or (rung is not None and is_behind(state.rungs[:, rung]))
    )


def fresh_count(learner: Learner) -> int:
    """On how many layouts candidates are tried again: the fewer there are beside champion and rival, the more."""
    return REEVALUATION_LAYOUTS * (REEVALUATED_CANDIDATES + 2) // (min(REEVALUATED_CANDIDATES, kept_count(learner)) + 2)


def climb(state: LessonState, scorer: Scorer, rung: int, seeds: Seeds) -> LessonState:
    """The champion's score at a rung, on the layouts of all attempts there."""
    marks = mark(scorer, state.champion, seeds)
    rungs = state.rungs.copy()
    rungs[-1, rung] = marks.scores[0]
    return replace(state, rungs=rungs, ticks=state.ticks + marks.ticks, faults=state.faults + marks.faults)


def try_again(state: LessonState, scorer: Scorer, fresh: Seeds) -> tuple[LessonState, float]:
    """The champion is who does best on fresh layouts, it or the best of the generation; and its score on them."""
    ranked = state.population.genomes[order(state.population.scores)]
    candidates = np.concatenate([state.champion, ranked[:REEVALUATED_CANDIDATES], state.rival])
    marks = mark(scorer, candidates, fresh)
    winner = int(order(marks.scores[: len(candidates) - len(state.rival)])[0])
    now = replace(
        state,
        champion=candidates[winner : winner + 1],
        ticks=state.ticks + marks.ticks,
        faults=state.faults + marks.faults,
    )
    if not len(state.rival) or is_better(marks.each[winner], marks.each[-1]):
        now = replace(now, rival=now.champion, since=state.population.generation)
    return now, float(marks.scores[winner])


def is_better(scores: Scores, than: Scores) -> bool:
    """Whether scores [layouts] are better than others on the same layouts by more than two standard errors."""
    if not np.isfinite(scores).all() or not np.isfinite(than).all():
        return bool(np.isfinite(scores).all())
    gain = scores - than
    return bool(gain.mean() > 2.0 * gain.std(ddof=1) / np.sqrt(len(gain)))


def are_different(scores: Scores) -> bool:
    """Whether there are two finite scores [genomes] that are not the same."""
    finite = scores[np.isfinite(scores)]
    return bool((finite != finite[:1]).any())


def judge(course: Course, scorer: Scorer, state: LessonState) -> tuple[LessonState, float]:
    """The end of an attempt: its champion tried on layouts common to all attempts; its score on the second half."""
    seeds = layouts(course.seed, 0, course.lesson.generations, 2 * VERDICT_LAYOUTS, Purpose.VERDICT)
    marks = mark(scorer, state.champion, seeds)
    verdict = marks.each[0].reshape(2, VERDICT_LAYOUTS).mean(axis=1)
    ended = replace(
        state,
        attempt=state.attempt + 1,
        population=nobody(course.start.shape[1]),
        champion=course.start,
        rival=course.start[:0],
        since=0,
        rungs=np.concatenate([state.rungs, not_climbed(course.lesson)]),
        champions=np.concatenate([state.champions, state.champion]),
        lengths=np.append(state.lengths, state.population.generation),
        verdicts=np.concatenate([state.verdicts, verdict[None]]),
        ticks=state.ticks + marks.ticks,
        faults=state.faults + marks.faults,
    )
    return ended, float(verdict[1])


def _mean(scores: Scores) -> float:
    finite = scores[np.isfinite(scores)]
    return float(finite.mean()) if len(finite) else -inf
