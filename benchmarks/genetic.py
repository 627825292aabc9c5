"""What the genetic algorithm itself costs: python benchmarks/genetic.py [--json].

Microseconds per genome and generation, without any simulation, for populations and genomes of several sizes.
"""

import argparse
import json
import time
from statistics import median

import numpy as np
from mindrun.kinds.learners import Genetic
from mindrun.train.ask_and_tell import ask, tell
from mindrun.train.population import Genomes, empty_population

SIZES = [(100, 28), (100, 450), (128, 500), (300, 1610)]


def cost(individuals: int, weights: int) -> float:
    """Median microseconds per genome to breed and take in a generation."""
    learner, rng = Genetic(population=individuals), np.random.default_rng(0)
    none = np.empty((0, weights), np.float32)
    population, times = empty_population(weights), []

    def draw(count: int, rng: np.random.Generator) -> Genomes:
        return rng.standard_normal((count, weights), np.float32)

    for _ in range(50):
        began = time.perf_counter()
        genomes = ask(population, learner, none, draw, rng)
        population = tell(population, learner, none, genomes, rng.normal(size=individuals))
        times.append((time.perf_counter() - began) / individuals * 1e6)
    return median(times)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--json", action="store_true")
    found = {f"{n} genomes of {w} weights": round(cost(n, w), 2) for n, w in SIZES}
    if parser.parse_args().json:
        print(json.dumps(found))
    else:
        for name, microseconds in found.items():
            print(f"{name}: {microseconds:.2f} µs per genome and generation")


if __name__ == "__main__":
    main()
