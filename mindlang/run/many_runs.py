"""Many runs of a task in which nobody learns: their layouts, and a slice of them after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np
from mindrun.graph.run_scores import Scores
from mindrun.processors import cpu_seconds

from mindlang.executors.job_scorer import Block, JobScorer, empty_scores, place
from mindlang.limits import as_runs, as_seed

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout

NO_GENOME = np.zeros((1, 0), np.float32)  # the genome where nobody learns
SLICE_RUNS = 1 << 16  # that are begun together, so that memory is for their results alone


def layouts(seed: int, runs: int) -> list[int]:
    """The seeds of so many runs; MindError where these are none."""
    seed, runs = as_seed(seed), as_runs(runs)
    return [int(word) for word in np.random.SeedSequence(seed).generate_state(runs, np.uint64)]


def run_all(
    scorer: Rollout | JobScorer, seeds: Sequence[int], ran: Callable[[float], None] = lambda runs: None
) -> Scores:
    """A run of each seed; `ran` is told how many more have been made, parts of them too."""
    if isinstance(scorer, JobScorer):
        return scorer.score(NO_GENOME, seeds, ran)
    whole = empty_scores(1, len(seeds), scorer.task)
    for first in range(0, len(seeds), SLICE_RUNS):
        block = Block(slice(0, 1), slice(first, min(len(seeds), first + SLICE_RUNS)))
        place(block, scorer.score(NO_GENOME, seeds[block.seeds], ran), whole)
    return whole


def run_timed(
    scorer: Rollout | JobScorer, seeds: Sequence[int], ran: Callable[[float], None] = lambda runs: None
) -> tuple[Scores, float, float]:
    """A run of each seed, the seconds that all of them took, and those of the processors of this machine.

    The first is made twice before where it may not be the same again, which is in the scorer's notes then.
    """
    scorer.make_again(NO_GENOME[0], seeds[0])
    began, cpu_began = perf_counter(), cpu_seconds()
    scores = run_all(scorer, seeds, ran)
    return scores, perf_counter() - began, cpu_seconds() - cpu_began
