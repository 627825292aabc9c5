"""Genomes × seeds as jobs: however they are cut, whoever does them in whichever order, the arrays are one machine's."""

from dataclasses import fields
from itertools import cycle

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.run_scores import Scores

from mindlang.executors import jobs
from mindlang.executors.jobs import JobScorer, blocks, runs_in_a_job
from tests.executors.counting import LENGTH, Counting, Shuffling

SHAPES = st.tuples(st.integers(0, 12), st.integers(0, 40))


def arrays(scores: Scores) -> dict[str, bytes]:
    return {each.name: getattr(scores, each.name).tobytes() for each in fields(scores)}


def drawn(shape: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    return rng.standard_normal((shape[0], LENGTH), np.float32), rng.integers(0, 2**63, shape[1], np.uint64)


@given(SHAPES, st.lists(st.integers(-3, 5), max_size=60), st.integers(1, 5), st.integers(1, 20))
def test_any_order_and_any_losses_come_to_the_same_arrays(
    shape: tuple[int, int], choices: list[int], width: int, first_runs: int
) -> None:
    genomes, seeds = drawn(shape)
    alone = Counting()
    expected = alone.score(genomes, seeds)
    executor, told = Shuffling(choices, width), list[float]()
    scorer = JobScorer(Counting(), executor)
    before, jobs.FIRST_RUNS = jobs.FIRST_RUNS, first_runs
    try:
        found = [scorer.score(genomes, seeds, told.append) for _ in range(2)]  # later it knows how long a run takes
    finally:
        jobs.FIRST_RUNS = before
    assert arrays(found[0]) == arrays(found[1]) == arrays(expected)
    assert sum(told) == 2 * genomes.shape[0] * len(seeds)
    assert scorer.rollout.tally().tolist() == (2 * alone.tally()).tolist()


@given(SHAPES, st.lists(st.integers(1, 100), min_size=1))
def test_blocks_are_every_run_once(shape: tuple[int, int], sizes: list[int]) -> None:
    asked, times = cycle(sizes), np.zeros(shape, int)
    for block in blocks(*shape, lambda: next(asked)):
        times[block.genomes, block.seeds] += 1
        assert block.runs == times[block.genomes, block.seeds].size <= max(sizes)
    assert (times == 1).all()


@given(st.integers(1, 10**7), st.integers(0, 2000), st.none() | st.floats(0, 1e5))
def test_a_job_has_at_least_a_run_and_is_not_too_long(all_runs: int, workers: int, seconds: float | None) -> None:
    runs = runs_in_a_job(all_runs, workers, seconds)
    assert runs >= 1
    assert seconds is None or runs == 1 or (runs - 1) * seconds <= jobs.JOB_SECONDS


def test_what_is_asked_after_an_interruption_takes_no_older_answer() -> None:
    class Interrupted(Shuffling):
        def next_result(self) -> tuple[int, object] | None:
            if next(self.choices, 0) == 9:  # type: ignore[call-overload]
                raise KeyboardInterrupt
            return Shuffling.next_result(self)

    scorer = JobScorer(Counting(), Interrupted([0, 0, 9]))
    genomes, seeds = drawn((4, 30))
    try:
        scorer.score(genomes, seeds)
        raise AssertionError("it was not interrupted")
    except KeyboardInterrupt:
        pass
    found = scorer.score(genomes[::-1], seeds)
    assert arrays(found) == arrays(Counting().score(genomes[::-1], seeds))
