"""Species: genomes that are alike compete with each other first, so that what has just grown has time to become better.

They are found anew in each generation from its genomes alone. The best of all leads a species, and so does the best
that is far enough from all leaders before (Li et al., 2002); who is near enough to several is of the first of these
species. How far that is follows from how many are wanted. Children are shared out by rank, which no scale of scores
changes.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from mindrun.train.population import Genomes, Scores

BISECTION_STEPS = 8  # of the interval in which the least distance between leaders is looked for

Places = NDArray[np.intp]


def species_of(ranked: Genomes, wanted: int, distance: Callable[[Genomes, Genomes], Scores]) -> tuple[Places, Places]:
    """The leaders [species] among genomes, best first, and the species of each genome [individuals].

    As many as are wanted, or fewer.
    """

    @cache
    def from_leader(rank: int) -> Scores:
        return distance(ranked, ranked[rank])

    def split(apart: float) -> tuple[list[int], Places]:
        leaders, species = list[int](), np.full(len(ranked), -1)
        while len(leaders) <= wanted and (left := np.flatnonzero(species < 0)).size:
            near = from_leader(int(left[0])) <= apart
            species[near & (species < 0)] = len(leaders)
            leaders.append(int(left[0]))
        return leaders, species

    low, high = 0.0, float(from_leader(0).max())
    for _ in range(BISECTION_STEPS):
        middle = (low + high) / 2
        low, high = (middle, high) if len(split(middle)[0]) > wanted else (low, middle)
    leaders, species = split(high)
    return np.array(leaders), species


def choose_parents(species: Places, tournament: int, count: int, rng: np.random.Generator) -> tuple[Places, Places]:
    """The ranks of mothers and fathers [count], both of one species: it has children by the mean of its ranks."""
    members, sizes = np.argsort(species, kind="stable"), np.bincount(species)
    shares = np.bincount(species, len(species) - np.arange(len(species))) / sizes
    chosen = rng.choice(len(sizes), count, p=shares / shares.sum())
    begins = (np.cumsum(sizes) - sizes)[chosen]
    drawn = rng.integers(sizes[chosen][None, :, None], size=(2, count, tournament)).min(axis=2)
    mothers, fathers = members[begins + drawn]
    return mothers, fathers
