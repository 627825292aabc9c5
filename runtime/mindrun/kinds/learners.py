"""Kinds of curricula: learners and their parameters. `train/ask_and_tell.py` has the learner of each."""

from dataclasses import replace
from itertools import accumulate
from math import sqrt
from typing import Annotated

from mindrun.kinds.registry import kind, left_out
from mindrun.numbers.quantity import GENERATIONS, Count, Quantity, Ratio

Octaves = Annotated[int, Quantity("a whole number up to 8", {"": 1.0}, low=0, high=8, whole=True)]
Spread = Annotated[float, Quantity("a number above zero", {"": 1.0}, low=1e-6, high=1000.0)]
Patience = Annotated[int, replace(GENERATIONS, low=0)]
Rungs = Annotated[int, Quantity("a whole number up to 16", {"": 1.0}, low=0, high=16, whole=True)]
SHARE = Quantity("a share above 0 up to 1", {"": 1.0, "%": 0.01}, low=0.001, high=1.0)
Share = Annotated[float, SHARE]
Founders = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=100_000, whole=True)]
Species = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=100, whole=True)]
FEW_CHILDREN = 0.1  # of a population that is bred anew
NEAR_WEIGHT = 0.01  # so near to another a weight does as that does
Population = Annotated[int, Quantity("a whole number of at least 4", {"": 1.0}, low=4, high=100_000, whole=True)]


@kind("curriculum", "genetic")
class Genetic:
    """The paper's learner: a genetic algorithm over the weights of one skill.

    Every generation, `population` genomes are scored on the same `layouts` worlds; `attempts` independent runs
    are made and the best is kept. `mutation` is the spread of a mutated weight, `mutated` the share of weights it
    hits; with `octaves` each child has its own, up to so many times doubled or halved. With `patience` an attempt ends
    early when its best has not become better beyond doubt for so many generations. From scratch, the first population
    is the best of `founders` random genomes, where these are more than it has. With `rungs` an attempt ends early at a
    half, a quarter, an eighth … of its generations, so many times, where it is not in the better half of the attempts
    that have come there (successive halving, as it stops trials one by one). With `short` an attempt begins in runs of
    that share of the task's ticks, and comes to whole ones over one length between: each of the three has a third of
    the ticks, and whatever is compared in the end was tried in whole runs. A lesson that changes skills of earlier ones
    and `keeps` a share of what these scored has failed where one of them has less, on the same fresh layouts before and
    after. With `lowest` the score of a genome is the mean of that share of its layouts, those on which it does worst:
    of 8 layouts, 25% are the worst two, 1% the worst one; so it is wherever genomes of the lesson are compared.
    With `species` genomes that are alike compete with each other first, in about so many groups. Of the children a
    share `grow` gets a neuron, `link` a link and `drop` loses one, where the function is a `neat`.
    A lesson may say any of these for itself.
    """

    population: Population = 100
    attempts: Count = 1
    layouts: Count = 2
    elite: Ratio = 0.1
    mutation: Spread = 0.5
    mutated: Ratio = 0.1
    octaves: Octaves = 0
    patience: Patience = 0
    founders: Founders = 0
    rungs: Rungs = 0
    short: Share = 1.0
    keeps: Ratio = 0.0
    lowest: Share = left_out(1.0)
    species: Species = left_out(0)
    grow: Ratio = left_out(0.03)
    link: Ratio = left_out(0.1)
    drop: Ratio = left_out(0.02)

    def standstill(self, weights: int, generations: int) -> str:
        """A sentence on why so many generations find nothing beyond the first genomes; empty if they may."""
        children = self.population - min(max(1, round(self.elite * self.population)), self.population - 1)
        bred = children * (generations - 1)
        if not bred:
            return "One generation is the first genomes alone, and nothing is bred from them"
        if children <= FEW_CHILDREN * self.population:
            return f"An elite of {self.elite:.0%} leaves {children} of {self.population} genomes to be bred anew"
        most = 2**self.octaves  # times as often and as far as is said
        if self.mutated * most * weights * bred < 1:
            return (
                f"With {self.mutated:.2g} of the weights mutated none ever is, and children mix the first genomes alone"
            )
        return _no_steps(self.mutation * most, generations)


@kind("curriculum", "restarting")
class Restarting(Genetic):
    """The genetic algorithm that gets there soonest: steps of all sizes, and no time for what is stuck.

    It is `genetic` with other defaults. An attempt that no longer becomes better ends at once, and of several attempts
    the best is kept.
    """

    attempts: Count = 4
    octaves: Octaves = 2
    patience: Patience = 40


@kind("curriculum", "evolution_strategy")
class EvolutionStrategy:
    """An evolution strategy (Rechenberg, 1973), which finishes in few generations what a skill knows already.

    Every generation, `population` genomes are drawn around one, a normal step of spread `mutation` away in all their
    weights, and scored on the same `layouts` worlds. Then that one moves to the mean of the best quarter of them,
    weighted by rank, in which the luck of single runs cancels out. From scratch it begins with the best of `founders`
    random genomes. `attempts`, `patience`, `rungs`, `short`, `keeps` and `lowest` are those of `genetic`.
    """

    population: Population = 50
    attempts: Count = 1
    layouts: Count = 2
    mutation: Spread = 0.2
    patience: Patience = 0
    founders: Founders = 0
    rungs: Rungs = 0
    short: Share = 1.0
    keeps: Ratio = 0.0
    lowest: Share = left_out(1.0)

    def standstill(self, weights: int, generations: int) -> str:
        """A sentence on why so many generations come nowhere; empty if they may."""
        return _no_steps(self.mutation, generations)


def _no_steps(spread: float, generations: int) -> str:
    """A sentence where so many steps of this spread leave every weight where it was, else empty."""
    if spread * generations >= NEAR_WEIGHT:
        return ""
    return f"Steps of {spread:g} leave every weight where it was, in {generations} generations"


Learner = Genetic | Restarting | EvolutionStrategy


def run_lengths(learner: Learner) -> list[tuple[float, float]]:
    """The lengths of an attempt's runs as shares of the task's, each with the share of the generations it ends after.

    There are three, with the geometric mean between the first and the whole, and each has a third of the ticks.

    >>> run_lengths(Genetic(short=0.25))
    [(0.25, 0.5714285714285714), (0.5, 0.8571428571428571), (1.0, 1.0)]
    """
    lengths = learner.short, sqrt(learner.short), 1.0
    ends = [*accumulate(1 / length for length in lengths)]
    return [(length, end / ends[-1]) for length, end in zip(lengths, ends, strict=True)]
