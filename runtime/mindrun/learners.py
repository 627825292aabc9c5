"""Kinds of curricula: how the lessons are learnt. `train/genetic.py` does it."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import COUNT, POSITIVE, RATIO, Quantity
from mindrun.registry import kind

POPULATION = Quantity("a whole number of at least 4", {"": 1.0}, low=4, high=100_000, whole=True)


@kind("curriculum", "genetic")
@dataclass(frozen=True, slots=True)
class Genetic:
    """The paper's learner: a genetic algorithm over the weights of one skill.

    Every generation, `population` genomes are scored on the same `layouts` worlds; `attempts` independent runs
    are made and the best is kept. `mutation` is the spread of a mutated weight, `mutated` the share of weights it
    hits. A lesson may say any of these for itself.
    """

    population: Annotated[int, POPULATION] = 100
    attempts: Annotated[int, COUNT] = 1
    layouts: Annotated[int, COUNT] = 2
    elite: Annotated[float, RATIO] = 0.1
    mutation: Annotated[float, POSITIVE] = 0.5
    mutated: Annotated[float, RATIO] = 0.1
