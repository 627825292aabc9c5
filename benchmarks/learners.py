"""Learners at the same number of ticks: python benchmarks/learners.py [--skill Avoid] [--ticks 100e6] [--seeds 3].

    --genetic octaves=2,mutation=2,mutated=0.2     the genetic algorithm, other than its defaults; may be repeated
    --cmaes population_size=32,sigma=1             CMA-ES by the library cmaes (pip install cmaes); may be repeated

Every seed teaches the skill from scratch, subskills as in the lock. The champion is chosen as in a lesson, and runs on
100 layouts that the training has not seen.
"""

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from learning import FRESH, prepared
from mindrun.learners import Genetic
from mindrun.sim.rollout import Rollout, cores
from mindrun.train.genetic import LIMIT, Genomes, Population, Scores, ask, nobody, order, tell
from mindrun.train.lesson import CANDIDATES, EVERY
from mindrun.train.lesson import FRESH as TRIES
from workloads import collect

ELSEWHERE = {"layouts": "--layouts says it", "attempts": "--seeds does it", "patience": "all have the same ticks"}
LINE = "{name:<44} {score:8.1f} ± {error:6.1f}   {count:6.1f} per run   {seconds:5.0f} s a seed"


class Learner(Protocol):
    """Asked for genomes [individuals, weights], told their scores [individuals]."""

    def ask(self) -> Genomes: ...

    def tell(self, genomes: Genomes, scores: Scores) -> None: ...


@dataclass(slots=True)
class ByGenes:
    """The genetic algorithm."""

    weights: int
    rng: np.random.Generator
    learner: Genetic
    population: Population = field(init=False)

    def __post_init__(self) -> None:
        self.population = nobody(self.weights)

    def ask(self) -> Genomes:
        return ask(self.population, self.learner, np.empty((0, self.weights), np.float32), self.rng)

    def tell(self, genomes: Genomes, scores: Scores) -> None:
        self.population = tell(self.population, genomes, scores)


class ByCovariance:
    """CMA-ES."""

    def __init__(self, weights: int, rng: np.random.Generator, sigma: float = 2.0, **options: Any) -> None:
        from cmaes import CMA

        self._cma = CMA(mean=np.zeros(weights), sigma=sigma, seed=int(rng.integers(2**31)), **options)

    def ask(self) -> Genomes:
        asked = np.array([self._cma.ask() for _ in range(self._cma.population_size)])
        return np.clip(asked, -LIMIT, LIMIT).astype(np.float32)

    def tell(self, genomes: Genomes, scores: Scores) -> None:
        worst = np.where(np.isfinite(scores), -scores, 1e9)
        self._cma.tell([(genome.astype(float), float(bad)) for genome, bad in zip(genomes, worst, strict=True)])


def learn(learner: Learner, rollout: Rollout, ticks: float, layouts: int, rng: np.random.Generator) -> Genomes:
    """The champion [1, weights] after so many ticks."""
    champion, taken, generation = np.empty((0, rollout.genome_length), np.float32), 0, 0
    while taken < ticks or generation % EVERY:
        genomes = learner.ask()
        scores = rollout.score(genomes, seeds(rng, layouts))
        totals = scores.total.mean(axis=1)
        learner.tell(genomes, totals)
        taken, generation = taken + int(scores.ticks.sum()), generation + 1
        if generation % EVERY == 0:
            candidates = np.concatenate([champion, genomes[order(totals)][:CANDIDATES]])
            scores = rollout.score(candidates, seeds(rng, TRIES))
            taken += int(scores.ticks.sum())
            champion = candidates[order(scores.total.mean(axis=1))][:1]
    return champion


def seeds(rng: np.random.Generator, count: int) -> list[int]:
    """The seeds of so many layouts."""
    return [int(word) for word in rng.integers(2**62, size=count)]


def compare(name: str, make: Callable[[np.random.Generator], Learner], rollout: Rollout, options: Any) -> None:
    """Print what a learner reaches, on the mean over the seeds with its standard error."""
    totals, counts, begin = [], [], time.perf_counter()
    for seed in range(1, options.seeds + 1):
        rng = np.random.default_rng(seed)
        champion = learn(make(rng), rollout, options.ticks, options.layouts, rng)
        scores = rollout.score(champion, [int(word) for word in FRESH])
        totals.append(float(scores.total.mean()))
        counts.append(float(scores.counts.mean()))
    error = float(np.std(totals, ddof=1)) / len(totals) ** 0.5 if len(totals) > 1 else 0.0
    seconds = (time.perf_counter() - begin) / options.seeds
    print(
        LINE.format(name=name, score=np.mean(totals), error=error, count=np.mean(counts), seconds=seconds), flush=True
    )


def settings(text: str) -> dict[str, float | int]:
    """What `octaves=2,mutation=0.5` says."""
    pairs = (part.partition("=") for part in text.split(",") if part)
    said: dict[str, float | int] = {key: int(value) if value.isdecimal() else float(value) for key, _, value in pairs}
    for key in said.keys() & ELSEWHERE.keys():
        raise argparse.ArgumentTypeError(f"{key} is not compared here: {ELSEWHERE[key]}")
    return said


def main() -> None:
    """Compare."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--skill", default="GoToObject")
    parser.add_argument("--ticks", type=float, default=40e6)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--layouts", type=int, default=2)
    parser.add_argument("--workers", type=int, default=cores())
    parser.add_argument("--genetic", action="append", type=settings, default=[])
    parser.add_argument("--cmaes", action="append", type=settings, default=[])
    options = parser.parse_args()
    graph, weights, _ = collect()
    _, rollout = prepared(graph, weights, options.skill, options.workers)
    length = rollout.genome_length
    print(f"{options.skill}, {length} weights, {options.ticks / 1e6:g} M ticks, {options.seeds} seeds")
    for said in [{}, *options.genetic]:
        compare(f"genetic {said}", lambda rng, said=said: ByGenes(length, rng, Genetic(**said)), rollout, options)
    for said in options.cmaes:
        compare(f"cmaes {said}", lambda rng, said=said: ByCovariance(length, rng, **said), rollout, options)


if __name__ == "__main__":
    main()
