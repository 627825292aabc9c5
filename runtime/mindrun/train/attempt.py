"""One attempt at a lesson: generation after generation, its best tried on fresh layouts; no other attempt is asked.

It is done in pieces: an executor is given a stretch of it, and returns a segment.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Lesson, Need, Task
from mindrun.graph.run_scores import Scores as RunScores
from mindrun.graph.weights import Weights
from mindrun.kinds.learners import Learner, run_lengths
from mindrun.train.ask_and_tell import ask, kept_count, tell
from mindrun.train.heredity import heredity_of
from mindrun.train.lesson_state import AttemptState, Course, Record, Verdict, rung_at
from mindrun.train.population import Scores, order
from mindrun.train.scoring import (
    Marks,
    Purpose,
    Scorer,
    Seeds,
    breeding_generator,
    layouts,
    lowest_mean,
    lowest_of,
    mark,
    marks_of,
    measured,
    with_hard,
)

SEGMENT_SECONDS = 2.0  # after which a segment ends with the generation at work
SEGMENT_GENERATIONS = 100  # at most in a segment
REEVALUATION_GENERATIONS = 10  # between two re-evaluations
REEVALUATED_CANDIDATES = 4  # of a generation, that are re-evaluated beside the champion
REEVALUATION_LAYOUTS = 16  # layouts of a re-evaluation of so many candidates
VERDICT_LAYOUTS = 50  # layouts on which attempts are compared, and as many others on which the best is reported

Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class Stretch:
    """A job: attempt `number`, which counts from 0, from a state on; with `cut` it ends there, and is judged."""

    number: int
    state: AttemptState
    cut: bool = False


@dataclass(frozen=True, slots=True)
class Segment:
    """The result of a stretch: the records of its generations, the champion of each, and the state after it.

    `verdict` is there where the attempt has ended.
    """

    state: AttemptState
    records: tuple[Record, ...]
    champions: tuple[Weights, ...]
    verdict: Verdict | None

    def then(self, later: "Segment") -> "Segment":
        """This segment and one that begins where it ends, as one."""
        return replace(later, records=(*self.records, *later.records), champions=(*self.champions, *later.champions))


def advance(course: Course, scorer: Scorer, stretch: Stretch, clock: Clock, most: int = SEGMENT_GENERATIONS) -> Segment:
    """Do a stretch: until the attempt ends by itself, comes to a rung, or has had seconds or generations enough."""
    state, records, champions, began = stretch.state, list[Record](), list[Weights](), clock()
    verdict = judge(course, scorer, state) if stretch.cut else None
    while verdict is None:
        start = clock()
        state, record = generation(course, scorer, stretch.number, state)
        enough, record = is_enough(course, scorer, stretch.number, state, record)
        if enough or ends_by_itself(course.lesson, state):
            verdict = judge(course, scorer, state)
        records.append(replace(record, seconds=clock() - start))
        champions.append(state.champion[0])
        is_at_rung = rung_at(course.lesson, state.population.generation) is not None
        if is_at_rung or clock() - began >= SEGMENT_SECONDS or len(records) >= most:
            break
    return Segment(state, tuple(records), tuple(champions), verdict)


def generation(course: Course, scorer: Scorer, number: int, state: AttemptState) -> tuple[AttemptState, Record]:
    """One generation of attempt `number`: bred, scored, and every now and then its best tried on fresh layouts."""
    lesson, learner = course.lesson, course.lesson.learner
    key = course.seed, number, state.population.generation
    rng = breeding_generator(*key)
    genomes = ask(state.population, learner, course.start, scorer.draw, rng, heredity_of(scorer))
    ticks = run_ticks(lesson, scorer.task, state.population.generation)
    seeds = with_hard(layouts(*key, learner.layouts), lesson.hard, *key)
    marks = mark(scorer, genomes, seeds, learner.lowest, ticks)
    population = tell(state.population, learner, course.start, genomes, marks.scores)
    now = replace(state, population=population, told_apart=state.told_apart or are_different(marks.scores))
    done, reevaluated = [marks], None
    generations, rung = population.generation, rung_at(lesson, population.generation)
    first_or_tenth = generations == 1 or generations % REEVALUATION_GENERATIONS == 0
    if first_or_tenth or rung is not None or ends_by_itself(lesson, now):
        fresh = layouts(*key, fresh_count(learner), Purpose.REEVALUATION)
        now, again, reevaluated = reevaluate(now, scorer, fresh, learner.lowest)
        done.append(again)
    if rung is not None:
        common = layouts(course.seed, 0, generations, VERDICT_LAYOUTS, Purpose.RUNG)
        done.append(mark(scorer, now.champion, common, learner.lowest))
        now = replace(now, climbed=now.climbed.copy())
        now.climbed[rung] = done[-1].scores[0]
    ticks, faults = sum(each.ticks for each in done), sum(each.faults for each in done)
    finite = marks.scores[np.isfinite(marks.scores)]
    best, mean = float(marks.scores.max()), float(finite.mean()) if len(finite) else -inf
    return now, Record(number + 1, generations, best, mean, reevaluated, None, ticks, 0.0, faults)


def run_ticks(lesson: Lesson, task: Task, generation: int) -> int:
    """How long the runs of a generation last, counted from 0: `short` first, in the end as long as the task says."""
    length = next((length for length, end in run_lengths(lesson.learner) if generation < end * lesson.generations), 1.0)
    return max(1, round(length * task.ticks))


def ends_by_itself(lesson: Lesson, state: AttemptState) -> bool:
    """True if an attempt has had all its generations, or has not become better for too many."""
    number = state.population.generation
    return number == lesson.generations or 0 < lesson.learner.patience <= number - state.since


def is_enough(course: Course, scorer: Scorer, number: int, state: AttemptState, record: Record) -> tuple[bool, Record]:
    """True if the champion of attempt `number`, once it was tried again, does what its lesson goes on until.

    It is judged on layouts of its own, which choose nothing. The record has the ticks of that, too.
    """
    lesson, until = course.lesson, course.lesson.until
    if until is None or record.reevaluated is None:
        return False, record
    key = course.seed, number, state.population.generation
    results = scorer.score(state.champion, layouts(*key, VERDICT_LAYOUTS, Purpose.ENOUGH))
    marks = marks_of(results)
    reached = lowest_mean(measured(until, scorer.task, results), _share(lesson, until))
    return until.is_met(float(reached[0])), replace(
        record, ticks=record.ticks + marks.ticks, faults=record.faults + marks.faults
    )


def fresh_count(learner: Learner) -> int:
    """The number of layouts of a re-evaluation: the fewer candidates beside champion and rival, the more layouts."""
    return REEVALUATION_LAYOUTS * (REEVALUATED_CANDIDATES + 2) // (min(REEVALUATED_CANDIDATES, kept_count(learner)) + 2)


def reevaluate(
    state: AttemptState, scorer: Scorer, fresh: Seeds, lowest: float = 1.0
) -> tuple[AttemptState, Marks, float]:
    """Make the best on fresh layouts champion, the old one or one of the generation's best; and its score on them."""
    ranked = state.population.genomes[order(state.population.scores)]
    candidates = np.concatenate([state.champion, ranked[:REEVALUATED_CANDIDATES], state.rival])
    marks = mark(scorer, candidates, fresh, lowest)
    winner = int(order(marks.scores[: len(candidates) - len(state.rival)])[0])
    now = replace(state, champion=candidates[winner : winner + 1])
    if not len(state.rival) or is_better(marks.each[winner], marks.each[-1], lowest):
        now = replace(now, rival=now.champion, since=state.population.generation)
    return now, marks, float(marks.scores[winner])


def judge(course: Course, scorer: Scorer, state: AttemptState) -> Verdict:
    """The end of an attempt: its champion tried on layouts common to all attempts."""
    results = scorer.score(state.champion, verdict_layouts(course.seed, course.lesson.generations))
    marks = marks_of(results)
    passed = has_needed(course.lesson, scorer.task, results)
    return Verdict(of_halves(marks.each, course.lesson.learner.lowest), passed, marks.ticks, marks.faults)


def has_needed(lesson: Lesson, task: Task, results: RunScores) -> bool:
    """True if a genome meets all needs of a lesson, by its results on each half of the layouts of a verdict."""
    return all(
        need.is_met(float(of_halves(measured(need, task, results), _share(lesson, need)).min()))
        for need in lesson.needs
    )


def _share(lesson: Lesson, need: Need) -> float:
    """The share of runs, the lowest, that a need is about: all of them, where it is about no score."""
    return lesson.learner.lowest if need.measure == "score" else 1.0


def verdict_layouts(seed: int, generations: int) -> Seeds:
    """The seeds [2 * VERDICT_LAYOUTS] of the worlds on which all attempts of a lesson are tried in the end."""
    return layouts(seed, 0, generations, 2 * VERDICT_LAYOUTS, Purpose.VERDICT)


def of_halves(values: NDArray[Any], lowest: float = 1.0) -> Scores:
    """The means [2] of the lowest share of a genome's values [1, 2 * VERDICT_LAYOUTS] on either half of the layouts."""
    return lowest_mean(values[0].reshape(2, VERDICT_LAYOUTS), lowest)


def is_better(scores: Scores, than: Scores, lowest: float = 1.0) -> bool:
    """True if scores [layouts] are better than others on the same layouts by more than two standard errors.

    Where the lowest share counts, the lowest are held against the lowest; of one alone there is no error.
    """
    if not np.isfinite(scores).all() or not np.isfinite(than).all():
        return bool(np.isfinite(scores).all())
    gain = scores - than if lowest == 1 else lowest_of(scores, lowest) - lowest_of(than, lowest)
    return bool(gain.mean() > (2.0 * gain.std(ddof=1) / np.sqrt(len(gain)) if len(gain) > 1 else 0.0))


def are_different(scores: Scores) -> bool:
    """True if two finite scores [genomes] differ."""
    finite = scores[np.isfinite(scores)]
    return bool((finite != finite[:1]).any())
