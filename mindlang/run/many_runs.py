"""Many runs of a task in which nobody learns: a slice after the other, so that memory is for their results alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from mindrun.run_scores import Scores
from mindrun.work.blocks import Block, empty_scores, place
from mindrun.work.job_scorer import JobScorer

from mindlang.run.layouts import NO_GENOME

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout

SLICE_RUNS = 1 << 16  # that are begun together


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
