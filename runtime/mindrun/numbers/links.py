"""The links of a network that grows: which there may be, which lead anywhere, and how one comes, goes or is split."""

from dataclasses import dataclass
from typing import Any
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.arrays import Bools

NEW_WEIGHT, NEW_BIAS = 4.0, -2.0  # of a neuron on a link: it rises with what it reads, and says 1/2 where that is 1/2
LEAST_WEIGHT = np.float32(2.0**-10)  # of a link that a step would have made none
WEIGHT_DISTANCE = 0.1  # of two genomes whose weights differ by 1; one with a link more is 1 away

Genomes = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Links:
    """A network as `cells` [rows, columns]: what each neuron reads, and below them what each output reads.

    The first rows and the last columns are the `most` neurons, the first column is the `bias`, if there is one. A
    cell of 0 is no link. Whatever changes one changes it in place.
    """

    cells: Genomes
    most: int
    bias: int
    is_recurrent: bool  # a neuron may read itself and those behind it
    centred: int = 0  # 1 if all is read less 1/2

    @property
    def direct(self) -> int:
        """The number of columns that are no neurons."""
        return len(self.cells[0]) - self.most

    @property
    def allowed(self) -> Bools:
        """The cells in which there may be a link."""
        found = np.ones(self.cells.shape, np.bool_)
        if not self.is_recurrent:
            found[: self.most, self.direct :] = np.tri(self.most, k=-1, dtype=np.bool_)
        return found

    @property
    def used(self) -> Bools:
        """The neurons [most] that have a link."""
        return np.logical_or(self.cells[: self.most].any(axis=1), self.cells[:, self.direct :].any(axis=0))

    @property
    def live(self) -> Bools:
        """The neurons [most] from which a way leads to an output."""
        read = self.cells[:, self.direct :] != 0
        found: Bools = read[self.most :].any(axis=0)
        for _ in range(self.most):
            found = found | read[: self.most][found].any(axis=0)
        return found

    def lose(self, rng: np.random.Generator) -> None:
        """Take a link away, and with it the neurons from which no way leads to an output any more."""
        there = np.flatnonzero(self.cells)
        if len(there):
            self.cells.flat[rng.choice(there)] = 0
            dead = ~self.live
            self.cells[: self.most][dead] = self.cells[:, self.direct :][:, dead] = 0

    def join(self, spread: float, rng: np.random.Generator) -> None:
        """Make a link between what is there, of a normal weight, if there is room for one."""
        free, unused = self.allowed & (self.cells == 0), ~self.used
        free[: self.most][unused] = free[:, self.direct :][:, unused] = False
        if free.any():
            self.cells.flat[rng.choice(np.flatnonzero(free))] = spread * rng.standard_normal()

    def split(self, rng: np.random.Generator) -> None:
        """Set a neuron on a link, which is no more: equal splits anywhere prefer the same free place."""
        there = np.argwhere(self.cells[:, self.bias :])
        if not len(there):
            return
        row, place = (int(each) for each in there[rng.integers(len(there))])
        column = self.bias + place
        source = column - self.direct
        between = range(max(source, -1) + 1, min(row, self.most)) if source < row else range(self.most)
        free = [neuron for neuron in between if not self.used[neuron]]
        if not free:
            return
        neuron = max(free, key=lambda each: crc32(f"{row} {place} {each}".encode()))
        self.cells[neuron, column], self.cells[neuron, : self.bias] = NEW_WEIGHT, NEW_BIAS * (not self.centred)
        self.cells[row, self.direct + neuron], self.cells[row, column] = self.cells[row, column], 0


def crossed(mothers: Genomes, fathers: Genomes, first: Bools, better: Bools) -> Genomes:
    """Children [individuals, weights]: a link of both is that of either, another that of the parent that did better."""
    both = (mothers != 0) & (fathers != 0)
    return np.where(np.where(both, first, better), mothers, fathers)


def moved(genomes: Genomes, steps: Genomes) -> Genomes:
    """Genomes [individuals, weights] with steps added: what is no link stays none, and none is lost."""
    found = genomes + steps
    return np.where(genomes == 0, genomes, np.where(found == 0, LEAST_WEIGHT, found))


def distance(genomes: Genomes, one: Genomes) -> NDArray[np.float64]:
    """How many links one of two genomes has alone, and a share of how far apart the weights of the others are."""
    there, its = genomes != 0, one != 0
    apart, both = (there != its).sum(axis=1), there & its
    near = np.where(both, np.abs(genomes - one), 0).sum(axis=1) / np.maximum(1, both.sum(axis=1))
    found: Any = apart + WEIGHT_DISTANCE * near
    return np.asarray(found, np.float64)
