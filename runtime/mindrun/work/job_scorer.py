"""A scorer whose runs are made by others: genomes × seeds become jobs, and the arrays are those of one machine."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.train.population import Genomes
from mindrun.train.scoring import is_one_world
from mindrun.work.blocks import Block, Blocks, empty_scores, place, runs_in_a_job
from mindrun.work.effort import Effort, Tally, effort_of, tally_of
from mindrun.work.executor import JobExecutor, job_about
from mindrun.work.frame import Frame, pack
from mindrun.work.score_frame import score_frame, scores_of


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
        self._about = job_about(jobs.assignment)
        self._asked = 0

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
                open_jobs[self._submit(block, genomes[block.genomes], words[block.seeds])] = block
            if (done := self.jobs.take()) is not None and (taken := open_jobs.pop(done[0], None)):
                scores, effort = done[1]
                effort.count_in(self.rollout)
                self._seconds = effort.seconds / taken.runs
                place(taken, scores, whole)
                ran(taken.runs)
        return whole

    def tally(self) -> Tally:
        """What was counted beside the results, by all workers."""
        return tally_of(self.rollout)

    def add(self, tally: Tally) -> None:
        """Count what was counted elsewhere."""
        self.rollout.add(tally)

    def close(self) -> None:
        """End all workers, whatever they do."""
        self.jobs.close()

    def _submit(self, block: Block, genomes: NDArray[np.float32], seeds: NDArray[np.uint64]) -> int:
        """Ask for a block; the number of its job, which nobody has had: one that was given up may still be answered."""
        self._asked += 1
        data = pack(score_frame(genomes, seeds, self._about))

        def came(answer: Frame) -> tuple[Scores, Effort]:
            return scores_of(answer, *block.shape, self.task), effort_of(answer, self.rollout)

        self.jobs.submit(self._asked, data, came)
        return self._asked
