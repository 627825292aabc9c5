"""A lesson that costs next to nothing: a sphere to climb down, with noise that depends on the layout."""

from dataclasses import dataclass
from time import perf_counter

import numpy as np
from mindrun.graph.graph import End, Lesson, Need, Task
from mindrun.kinds.events.event import Collision
from mindrun.kinds.learners import Genetic
from mindrun.kinds.scenes.scene import Plain
from mindrun.train.manifest import Manifest, hashes
from mindrun.train.training import Watch
from numpy.typing import NDArray

LENGTH = 12


@dataclass(frozen=True, slots=True)
class Results:
    total: NDArray[np.float64]
    ticks: NDArray[np.int64]
    faults: NDArray[np.int64]
    met: NDArray[np.int64]

    @property
    def by_event(self) -> NDArray[np.int64]:
        """A genome that has got near has collided twice."""
        return 2 * self.met[..., None]


@dataclass(frozen=True, slots=True)
class Sphere:
    """The score of a genome is minus its squared distance from all ones, give or take `noise`; near is a success."""

    genome_length: int = LENGTH
    noise: float = 0.5

    @property
    def task(self) -> Task:
        return Task("Climb", Plain(), (), 100, (), (Collision(),), (End(0), End(0, succeeds=True)), (), ())

    def draw(self, count: int, rng: np.random.Generator) -> NDArray[np.float32]:
        return 4 * rng.standard_normal((count, self.genome_length), np.float32)

    def score(self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ticks: int | None = None) -> Results:
        distance = ((genomes.astype(np.float64) - 1.0) ** 2).sum(axis=1)
        luck = self.noise * np.sin(np.outer(distance, 1.0 + np.asarray(seeds) % 97))
        total = -distance[:, None] + luck
        return Results(
            total, np.full(total.shape, 100), np.zeros(total.shape, np.int64), (total > -LENGTH).astype(np.int64)
        )


@dataclass(frozen=True, slots=True)
class Faulty(Sphere):
    """The sphere, where every genome with a first weight above `above` gives NaN."""

    above: float = 0.0

    def score(self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ticks: int | None = None) -> Results:
        results = Sphere.score(self, genomes, seeds)
        bad = genomes[:, 0] > self.above
        total = np.where(bad[:, None], np.nan, results.total)
        return Results(total, results.ticks, results.faults + bad[:, None], results.met)


@dataclass(frozen=True, slots=True)
class Flat(Sphere):
    """Every genome has the same score."""

    def score(self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ticks: int | None = None) -> Results:
        results = Sphere.score(self, genomes, seeds)
        return Results(np.zeros_like(results.total), results.ticks, results.faults, results.met)


def lesson(generations: int = 30, needs: tuple[Need, ...] = (), **learner: float) -> Lesson:
    genetic = Genetic(**{"population": 20, **learner})
    return Lesson("School", "Climb", "Climb", "Climb", generations, False, False, genetic, needs=needs)


def manifest(lesson: Lesson, seed: int = 1, weights: dict[str, NDArray[np.float32]] | None = None) -> Manifest:
    return Manifest(
        lesson=lesson,
        learners=(lesson.skill,),
        seed=seed,
        mind="0" * 64,
        weights=hashes(weights or {}),
        source="/nowhere/climb.mind",
        sources={},
        command=("mindc", "train"),
        started="2026-07-14T12:00:00Z",
        versions={},
        processor="",
    )


def forget(*_: object) -> None:
    """A report or a warning that nobody reads."""


def unwatched(save_every: float = 1e9, stop_after: int = 10**9) -> Watch:
    """Save in the end, or after so many seconds; stop after so many generations."""
    left = iter(range(10**9))
    return Watch(forget, forget, lambda: next(left) >= stop_after, perf_counter, save_every=save_every)
