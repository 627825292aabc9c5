"""Genomes × seeds cut into blocks, and what came of each put into its place."""

from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.work.score_frame import COUNTED, SUMMED, kind_of, shape_of

JOB_SECONDS = 1.0  # that a job takes at most, as far as is known: so much is lost with a worker
MIN_JOB_SECONDS = 0.1  # that it takes at least, while there is so much to do
JOBS_PER_WORKER = 2  # then, so that none waits long for the last
FIRST_RUNS = 16  # in a job of which nobody knows how long it takes


@dataclass(frozen=True, slots=True)
class Block:
    """Some genomes on some seeds."""

    genomes: slice
    seeds: slice

    @property
    def shape(self) -> tuple[int, int]:
        """How many."""
        return self.genomes.stop - self.genomes.start, self.seeds.stop - self.seeds.start

    @property
    def runs(self) -> int:
        """How many runs it is."""
        return self.shape[0] * self.shape[1]


def runs_in_a_job(runs: int, workers: int, seconds: float | None) -> int:
    """How many of all the runs make a good job, where a run takes so many seconds (None: nobody knows)."""
    if seconds is None:
        return FIRST_RUNS
    share = runs / (max(1, workers) * JOBS_PER_WORKER)
    fewest, most = MIN_JOB_SECONDS / max(seconds, 1e-9), JOB_SECONDS / max(seconds, 1e-9)
    return max(1, ceil(min(max(share, fewest), most)))


class Blocks:
    """What is left of genomes × seeds: whole genomes while a job is for more runs than there are seeds."""

    def __init__(self, genomes: int, seeds: int) -> None:
        self._shape, self._genome, self._seed = (genomes, seeds), 0, 0

    @property
    def left(self) -> int:
        """How many runs are left."""
        genomes, seeds = self._shape
        return max(0, (genomes - self._genome) * seeds - self._seed)

    def next(self, runs: int) -> Block:
        """The next block, of about so many runs, at least one."""
        genomes, seeds = self._shape
        at, first = self._genome, self._seed
        if first == 0 and runs >= seeds:
            self._genome = min(genomes, at + runs // seeds)
            return Block(slice(at, self._genome), slice(0, seeds))
        self._seed = min(seeds, first + max(1, runs))
        block = Block(slice(at, at + 1), slice(first, self._seed))
        if self._seed == seeds:
            self._genome, self._seed = at + 1, 0
        return block


def empty_scores(genomes: int, seeds: int, task: Task) -> Scores:
    """Room for what comes of all: arrays of zeros."""
    whole: dict[str, NDArray[Any]] = {}
    for name in (*SUMMED, *COUNTED):
        whole[name] = np.zeros(shape_of(name, genomes, seeds, task), kind_of(name))
    return Scores(**whole)


def place(block: Block, part: Any, whole: Scores) -> None:
    """Put what came of a block into its place."""
    for name in (*SUMMED, *COUNTED):
        getattr(whole, name)[block.genomes, block.seeds] = getattr(part, name)
