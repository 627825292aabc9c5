"""Genomes scored on layouts, by whatever simulates them.

All random numbers come from (run seed, attempt, generation, purpose), so that no state of a generator is ever saved.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from math import ceil, inf
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import HardLayouts, Need, Task
from mindrun.graph.run_scores import Scores as RunScores
from mindrun.train.population import Genomes, Scores

Seeds = NDArray[np.uint64]


class Purpose(IntEnum):
    """The purposes for which random numbers are drawn; each has its own stream."""

    BREEDING = 0
    LAYOUTS = 1
    REEVALUATION = 2
    VERDICT = 3
    COMPARISON = 4
    RUNG = 5
    RETENTION = 6
    ENOUGH = 7
    HARD = 8


def breeding_generator(seed: int, attempt: int, generation: int) -> np.random.Generator:
    return np.random.default_rng(_sequence(seed, attempt, generation, Purpose.BREEDING))


def layouts(seed: int, attempt: int, generation: int, count: int, purpose: Purpose = Purpose.LAYOUTS) -> Seeds:
    """The seeds [count] of the worlds on which one generation is scored, the same for every genome."""
    return _sequence(seed, attempt, generation, purpose).generate_state(count, np.uint64).astype(np.uint64)


def with_hard(seeds: Seeds, hard: HardLayouts | None, seed: int, attempt: int, generation: int) -> Seeds:
    """The seeds [count] of one generation, some of the hard ones in the place of the first.

    So many are hard as the share says, or one more as often as it takes for that share in the mean of all generations.
    """
    if hard is None:
        return seeds
    rng = np.random.default_rng(_sequence(seed, attempt, generation, Purpose.HARD))
    count = min(len(seeds), int(hard.share * len(seeds) + rng.random()))
    chosen = rng.choice(len(hard.seeds), count, replace=count > len(hard.seeds))
    return np.concatenate([np.array([int(hard.seeds[each]) for each in chosen], np.uint64), seeds[count:]])


def _sequence(seed: int, attempt: int, generation: int, purpose: Purpose) -> np.random.SeedSequence:
    return np.random.SeedSequence(seed, spawn_key=(attempt, generation, int(purpose)))


class Scorer(Protocol):
    """A scorer of genomes: `mindrun.sim.rollout.Rollout`, or anything of its shape."""

    @property
    def genome_length(self) -> int: ...  # how many weights the learner has
    @property
    def task(self) -> Task: ...  # what the genomes are scored in
    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, genome_length] for learning to begin with."""

    def score(self, genomes: Any, seeds: Any, *, ticks: int | None = None) -> RunScores:
        """Every genome on every seed, with `ticks` no longer than so many; a result depends on nothing else."""


class WrappedScorer:
    """A scorer that has another one do something of its own way; what it does not say itself is that one's."""

    def __init__(self, scorer: Any) -> None:
        self.rollout = scorer
        self.task: Task = scorer.task
        self.genome_length: int = scorer.genome_length
        self.is_one_world = is_one_world(scorer)
        self.learners = getattr(scorer, "learners", ())
        self.draw: Callable[[int, np.random.Generator], Genomes] = scorer.draw


@dataclass(frozen=True, slots=True)
class Marks:
    """Scores of genomes: `each` [genomes, layouts], `scores` [genomes] from these; ticks and faults in all."""

    each: Scores
    scores: Scores
    ticks: int
    faults: int


def is_one_world(scorer: Scorer) -> bool:
    """True if a scorer says that every seed is the same world to it; most have never heard of that."""
    return bool(getattr(scorer, "is_one_world", False))


def mark(
    scorer: Scorer, genomes: Genomes, seeds: Seeds | Sequence[int], lowest: float = 1.0, ticks: int | None = None
) -> Marks:
    """Score every genome on every seed, in runs of so many ticks; a genome with a fault anywhere has -inf.

    Its score is the mean of the `lowest` share of its layouts.

    Where all worlds are one a genome has one run, whose score stands for all of its seeds.
    """
    if not is_one_world(scorer):
        return marks_of(scorer.score(genomes, seeds, ticks=ticks), lowest)
    marks = marks_of(scorer.score(genomes, seeds[:1], ticks=ticks))
    return replace(marks, each=np.repeat(marks.each, len(seeds), axis=1))


def lowest_mean(each: Scores, share: float) -> Scores:
    """The means [genomes] of the lowest share of scores [genomes, layouts], rounded up; of all of them for 1."""
    return np.asarray((each if share == 1 else lowest_of(each, share)).mean(axis=1))


def lowest_of(each: Scores, share: float) -> Scores:
    """The lowest share of scores [..., layouts], rounded up, the least first."""
    count = ceil(round(share * each.shape[-1], 9))
    return np.sort(each, axis=-1)[..., :count]


def marks_of(results: RunScores, lowest: float = 1.0) -> Marks:
    """The scores in what was measured; a genome with a fault anywhere has -inf."""
    faulty = (results.faults > 0) | ~np.isfinite(results.total)
    each = np.where(faulty, -inf, results.total)
    return Marks(each, lowest_mean(each, lowest), int(results.ticks.sum()), int(faulty.sum()))


def succeeded(task: Task, results: RunScores) -> NDArray[np.bool_]:
    """A mask [genomes, seeds] of the runs that met a success before any other end, whether or not it ended them."""
    successes = [number for number, end in enumerate(task.ends) if end.succeeds]
    return np.isin(results.met, successes)


def measured(need: Need, task: Task, results: RunScores) -> NDArray[Any]:
    """The figures [genomes, seeds] that a need of a lesson on a task is about, one for each run.

    ValueError where it is about an event that the task does not have.
    """
    match need.measure:
        case "score":
            return marks_of(results).each
        case "success":
            return succeeded(task, results)
        case "event":
            return results.by_event[..., task.events.index(need.event)]
