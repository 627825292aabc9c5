"""One lesson of any agent, by the lesson's own code: attempts until the ticks are spent, and how its champion climbed.

What agents do otherwise than others stands in front of a rollout: a scorer of genomes, as the lesson asks for one.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mindrun.graph.graph import Lesson, Task
from mindrun.graph.run_scores import Scores
from mindrun.kinds.learners import EvolutionStrategy, Learner, run_lengths
from mindrun.sim.rollout import Rollout
from mindrun.train.attempt import (
    REEVALUATED_CANDIDATES,
    REEVALUATION_GENERATIONS,
    REEVALUATION_LAYOUTS,
    VERDICT_LAYOUTS,
    judge,
)
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin, ended
from mindrun.train.population import Draw, Genomes, order
from mindrun.train.training import best
from numpy.typing import NDArray

FINISH = EvolutionStrategy(mutation=0.12)
FOUNDERS_SHARE, MOST_FOUNDERS = 0.15, 2000  # of an attempt's ticks; genomes
ENDLESS_ATTEMPTS = 10**6  # attempts
Curve = list[tuple[int, float]]  # after so many ticks the best champion so far counts so much in a run


class Timed:
    """A scorer that adds up the ticks of another, and notes what the best so far counts where runs are whole.

    That is the champion of the attempt at work, or the kept one of those before, by the verdicts on them.
    """

    def __init__(self, scorer: Any) -> None:
        self._scorer, self._kept = scorer, (-np.inf, 0.0)
        self.genome_length: int = scorer.genome_length
        self.task: Task = scorer.task
        self.draw: Draw = scorer.draw
        self.ticks, self.curve = 0, Curve()

    def score(self, genomes: Genomes, seeds: Any, *, ticks: int | None = None) -> Scores:
        """Every genome on every seed."""
        scores: Scores = self._scorer.score(genomes, seeds, ticks=ticks)
        self.ticks += int(scores.ticks.sum())
        if ticks is None:
            totals = scores.total.mean(axis=1)
            winner = order(totals)[0]
            best = float(totals[winner]), float(scores.counts[winner].mean())
            if len(seeds) == 2 * VERDICT_LAYOUTS:
                best = self._kept = max(self._kept, best)
            self.curve.append((self.ticks, max(self._kept[1], best[1])))
        return scores


@dataclass(frozen=True, slots=True)
class Effort:
    """The effort of a lesson: the learner, its ticks, and the attempts, each of which has a part of them."""

    learner: Learner
    ticks: float
    attempts: int = 1


def teach(scorer: Any, start: Genomes, seed: int, effort: Effort) -> tuple[Genomes, Timed]:
    """The champion [1, weights] of attempts that begin with `start` [0 or 1, weights], and the scorer that timed them.

    As many attempts are made as the ticks allow. The one that does best on fresh layouts is kept.
    """
    timed, task = Timed(scorer), scorer.task
    learner, generations = planned(effort, task.ticks)
    course = Course(Lesson("", "", task.name, "", generations, False, False, learner), seed, start)
    state = begin(course)
    executor = InThisThread(course, timed, time.perf_counter)
    for step in side_by_side(course, executor, state, lambda: timed.ticks >= effort.ticks):
        state = step.state
    if len(state.now.champion):
        state = ended(course, state, judge(course, timed, state.now))
    return best(state), timed


def planned(effort: Effort, run_ticks: int) -> tuple[Learner, int]:
    """The learner, and how many generations its share of the ticks buys where no run ends before its time."""
    runs = effort.ticks / effort.attempts / run_ticks
    learner = replace(effort.learner, attempts=ENDLESS_ATTEMPTS)
    founders = int(FOUNDERS_SHARE * runs / learner.layouts / learner.short)
    learner = replace(learner, founders=min(founders, MOST_FOUNDERS))
    lengths = run_lengths(learner)
    generation = learner.population * learner.layouts * len(lengths) / sum(1 / length for length, _ in lengths)
    again = (REEVALUATED_CANDIDATES + 2) * REEVALUATION_LAYOUTS / REEVALUATION_GENERATIONS
    first = max(learner.founders, learner.population) * learner.layouts * learner.short + 2 * VERDICT_LAYOUTS
    return learner, max(1, int((runs - first) / (generation + again)))


@dataclass(frozen=True, slots=True)
class Front:
    """A scorer in front of a rollout, of whose genomes it has as many weights."""

    rollout: Rollout

    @property
    def genome_length(self) -> int:
        """The number of weights of a genome."""
        return self.rollout.genome_length

    @property
    def task(self) -> Task:
        """The task of the lesson."""
        return self.rollout.task

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, genome_length]."""
        return self.rollout.draw(count, rng)


@dataclass(frozen=True, slots=True)
class Replay(Front):
    """Scores on the task and, every other seed, on one of `earlier` tasks that the seed chooses.

    They are parts of `good` ones, those of a good skill on each of these tasks, the lesson's own last. What is counted
    is of the lesson's task alone.
    """

    earlier: Sequence[Rollout]
    good: Sequence[float]

    def score(self, genomes: Genomes, seeds: Any, *, ticks: int | None = None) -> Scores:
        """Every genome on every seed."""
        words = np.asarray(seeds, np.uint64)
        number = np.where(np.arange(len(words)) % 2, (words % np.uint64(len(self.earlier))).astype(int), -1)
        parts = {each: (self.earlier[each] if each >= 0 else self.rollout) for each in np.unique(number).tolist()}
        scores = {each: rollout.score(genomes, words[number == each], ticks=ticks) for each, rollout in parts.items()}
        joined = {}
        for column in ("total", "ticks", "faults", "met"):
            joined[column] = np.empty((len(genomes), len(words)), getattr(scores[-1], column).dtype)
            for each, found in scores.items():
                joined[column][:, number == each] = getattr(found, column)
        joined["total"] /= np.asarray(self.good)[number]
        return replace(scores[-1], **joined)


@dataclass(frozen=True, slots=True)
class Anchored(Front):
    """Scores less points for leaving `anchor` [weights]: the more, the more outputs depended on those that change.

    `importance` says how much they did for each weight; `points` is what a change of 1 in the outputs costs in a whole
    run.
    """

    anchor: NDArray[np.float32]
    importance: NDArray[np.float32]
    points: float

    def score(self, genomes: Genomes, seeds: Any, *, ticks: int | None = None) -> Scores:
        """Every genome on every seed."""
        scores = self.rollout.score(genomes, seeds, ticks=ticks)
        cost = self.points * min(ticks or self.task.ticks, self.task.ticks) / self.task.ticks
        left = (self.importance * (genomes - self.anchor) ** 2).sum(axis=1)
        return replace(scores, total=scores.total - cost * np.reshape(left, (-1, 1)))


@dataclass(frozen=True, slots=True)
class Part(Front):
    """Scores of some weights of a genome, by their `places`; the others stay as in `whole` [weights]."""

    whole: NDArray[np.float32]
    places: NDArray[np.intp]

    @property
    def genome_length(self) -> int:
        """The number of places."""
        return len(self.places)

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, places]."""
        return self.rollout.draw(count, rng)[:, self.places]

    def score(self, genomes: Genomes, seeds: Any, *, ticks: int | None = None) -> Scores:
        """Every genome on every seed."""
        whole = np.repeat(self.whole[None], len(genomes), axis=0)
        whole[:, self.places] = genomes
        return self.rollout.score(whole, seeds, ticks=ticks)
