"""The genomes of a lesson as its skills take them: a function of each says how it is crossed, moved and grown."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Skill
from mindrun.graph.skill_sets import genes
from mindrun.kinds.functions.function import Function
from mindrun.kinds.learners import Genetic
from mindrun.train.population import Genomes, Scores

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Part:
    """The weights of one skill within a genome, and its function, of so many outputs."""

    place: slice
    function: Function
    outputs: int


@dataclass(frozen=True, slots=True)
class Heredity:
    """The parts of a genome, one after the other."""

    parts: tuple[Part, ...] = (Part(slice(None), Function(), 0),)

    def crossed(self, mothers: Genomes, fathers: Genomes, first: Mask, better: Mask) -> Genomes:
        """Children [individuals, weights]; `first` [individuals, weights] and `better` [individuals, 1] as a part's."""
        cut = ((each.function, each.place) for each in self.parts)
        made = [of.crossed(mothers[:, at], fathers[:, at], first[:, at], better) for of, at in cut]
        return np.concatenate(made, axis=1)

    def moved(self, genomes: Genomes, steps: Genomes) -> Genomes:
        """The genomes [individuals, weights] with steps added where there is something to move."""
        cut = ((each.function, each.place) for each in self.parts)
        return np.concatenate([of.moved(genomes[:, at], steps[:, at]) for of, at in cut], axis=1)

    def grown(self, genomes: Genomes, rates: Genetic, rng: np.random.Generator) -> Genomes:
        """The genomes [individuals, weights], some with other links."""
        made = [each.function.grown(genomes[:, each.place], each.outputs, rates, rng) for each in self.parts]
        return np.concatenate(made, axis=1)

    def distance(self, genomes: Genomes, one: Genomes) -> Scores:
        """How far genomes [individuals, weights] are from one [weights]: [individuals]."""
        cut = ((each.function, each.place) for each in self.parts)
        apart: Scores = np.sum([of.distance(genomes[:, at], one[at]) for of, at in cut], axis=0)
        return apart


def heredity_of(scorer: Any) -> Heredity:
    """The parts of the genomes that a scorer scores; one without a structure where it has not heard of skills."""
    return Heredity((*_parts(getattr(scorer, "learners", ())),) or Heredity().parts)


def _parts(learners: tuple[Skill, ...]) -> Iterator[Part]:
    begin = 0
    for skill in learners:
        end = begin + genes(skill)
        yield Part(slice(begin, end), skill.function, skill.outputs)
        begin = end
