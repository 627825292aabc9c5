"""A scorer whose runs are made by others: genomes × seeds become jobs, and the arrays are those of one machine."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import ceil
from typing import Any

import numpy as np
from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.train.population import Genomes
from mindrun.train.scoring import is_one_world
from numpy.typing import NDArray

from mindlang.executors.jobs import JobExecutor, Tally, tally_of

JOB_SECONDS = 1.0  # that a job takes at most, as far as is known: so much is lost with a worker
MIN_JOB_SECONDS = 0.1  # that it takes at least, while there is so much to do
JOBS_PER_WORKER = 2  # then, so that none waits long for the last
FIRST_RUNS = 16  # in a job of which nobody knows how long it takes
COUNTED = ("counts", "by_event", "ticks", "ended_by", "met", "faults")
SUMMED = ("total", "by_line")


class JobScorer:
    """Scores as `rollout` would, by the workers of an executor. A result depends on its genome and its seed alone.

    So neither how many workers there are, nor how runs are cut into jobs, nor in which order these end, changes a bit.
    """

    def __init__(self, rollout: Any, jobs: JobExecutor) -> None:
        self.rollout, self.jobs = rollout, jobs
        self.task: Task = rollout.task
        self.genome_length: int = rollout.genome_length
        self.is_one_world = is_one_world(rollout)
        self._seconds: float | None = None  # that a run takes, by the last job
        self._asked = 0  # the number of the last job: one that was given up may still be answered

    @property
    def notes(self) -> tuple[str, ...]:
        """What somebody should know of the runs so far."""
        notes: tuple[str, ...] = self.rollout.notes
        return notes

    def make_again(self, genome: NDArray[np.float32], seed: int) -> None:
        """Make a run twice here, where it may not be the same again."""
        self.rollout.make_again(genome, seed)

    def draw(self, count: int, rng: np.random.Generator) -> Genomes:
        """Random genomes [count, genome_length] for learning to begin with."""
        genomes: Genomes = self.rollout.draw(count, rng)
        return genomes

    def score(
        self,
        genomes: NDArray[np.float32],
        seeds: Sequence[int] | NDArray[np.uint64],
        ran: Callable[[float], None] = lambda runs: None,
    ) -> Scores:
        """Every genome [genomes, genome_length] on every seed; `ran` is told how many more runs have been made."""
        if not np.isfinite(genomes).all():
            raise ValueError("a genome has weights that are not finite numbers")
        genomes, words = np.ascontiguousarray(genomes, np.float32), np.array(seeds, np.uint64)
        whole = empty_scores(len(genomes), len(words), self.task)
        blocks, open_jobs = Blocks(len(genomes), len(words)), dict[int, Block]()
        while blocks.left or open_jobs:
            while blocks.left and self.jobs.has_room():
                block = blocks.next(runs_in_a_job(genomes.shape[0] * len(words), self.jobs.workers, self._seconds))
                self._asked += 1
                self.jobs.submit(self._asked, partial(_score, genomes[block.genomes], words[block.seeds]))
                open_jobs[self._asked] = block
            if (taken := self.jobs.take()) is not None and (block_done := open_jobs.pop(taken[0], None)):
                done = taken[1]
                done.count_in(self.rollout)
                self._seconds = done.seconds / block_done.runs
                place(block_done, done.result, whole)
                ran(block_done.runs)
        return whole

    def tally(self) -> Tally:
        """What was counted beside the results, by all workers."""
        return tally_of(self.rollout)

    def add(self, tally: Tally) -> None:
        """Count what was counted elsewhere."""
        self.rollout.add(tally)


def _score(genomes: NDArray[np.float32], seeds: NDArray[np.uint64], scorer: Any) -> Scores:
    """Every genome [genomes, weights] on every seed."""
    scores: Scores = scorer.score(genomes, seeds)
    return scores


@dataclass(frozen=True, slots=True)
class Block:
    """Some genomes on some seeds."""

    genomes: slice
    seeds: slice

    @property
    def runs(self) -> int:
        """How many runs it is."""
        return int((self.genomes.stop - self.genomes.start) * (self.seeds.stop - self.seeds.start))


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
        self._genomes, self._seeds, self._done = genomes, seeds, 0

    @property
    def left(self) -> int:
        """How many runs are left."""
        return self._genomes * self._seeds - self._done

    def next(self, runs: int) -> Block:
        """The next block, of about so many runs, at least one."""
        genome, seed = divmod(self._done, self._seeds)
        if seed == 0 and runs >= self._seeds:
            last = min(self._genomes, genome + runs // self._seeds)
            block = Block(slice(genome, last), slice(0, self._seeds))
        else:
            block = Block(slice(genome, genome + 1), slice(seed, min(self._seeds, seed + max(1, runs))))
        self._done += block.runs
        return block


def empty_scores(genomes: int, seeds: int, task: Task) -> Scores:
    """Room for what comes of all: arrays of zeros."""
    more = {"by_line": (max(1, len(task.rewards)),), "by_event": (len(task.events),)}
    whole: dict[str, NDArray[Any]] = {}
    for name in (*SUMMED, *COUNTED):
        whole[name] = np.zeros((genomes, seeds, *more.get(name, ())), np.float64 if name in SUMMED else np.int64)
    return Scores(**whole)


def place(block: Block, part: Any, whole: Scores) -> None:
    """Put what came of a block into its place."""
    for name in (*SUMMED, *COUNTED):
        getattr(whole, name)[block.genomes, block.seeds] = getattr(part, name)
