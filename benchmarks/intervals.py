"""How often the interval of `mindc bench A B` contains the true difference: python benchmarks/intervals.py [--minds].

Scores of two minds are drawn in ways that are hard for intervals (CASES); with --minds pairs of minds of
examples/collect run on common layouts, and comparisons are drawn from these with replacement. For each number of runs:
of 4,000 comparisons, the share of those with an interval that contains the mean difference, beside it Student's; how
wide it is beside Student's in the median; how often there is none, since no run differed; how often it is said that
unseen layouts made it so wide. Every sentence says of how rare a layout the runs need have no example.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from math import exp, sqrt
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.processors import cores
from numpy.typing import NDArray

from mindlang.compiler.compile import load
from mindlang.run.paired_difference import difference, t_quantile
from mindlang.run.setup import NO_GENOME, layouts, set_up

Floats = NDArray[np.floating[Any]]
Rng = np.random.Generator
COLLECT = Path(__file__).resolve().parent.parent / "examples" / "collect"
PAIRS = {  # task: two minds, each with its master
    "Collect": (("collect.mind", "Collect"), ("best.mind", "Deliver")),
    "GoToObject": (("collect.mind", "GoToObject"), ("collect.mind", "Collect")),
    "Avoid": (("collect.mind", "Avoid"), ("best.mind", "Avoid")),
}
RUNS_COMPARED = 5, 10, 20, 50, 100, 200, 1000
COMPARISONS_DRAWN = 4000
LAYOUT_SEED, LAYOUT_COUNT = 17, 10_000
NOISE_STD = 0.001  # in which minds differ that are as good as the same
HEAD = f"  {'runs':>5}  {'covers':>7}  {'Student':>7}  {'width':>7}  {'none':>6}  {'unseen':>6}"


@dataclass(frozen=True, slots=True)
class Case:
    """Scores of two minds, drawn [comparisons, runs], and their true mean difference."""

    draw: Callable[[Rng, tuple[int, int]], tuple[Floats, Floats]]
    truth: float


def collapsing(share: float, to: float = 0.0) -> Case:
    """One mind is the other, but for a share of the layouts."""

    def draw(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
        first = rng.normal(10, 3, shape)
        second = first + rng.normal(0, NOISE_STD, shape)
        return first, np.where(rng.random(shape) < share, to, second)

    return Case(draw, share * (to - 10))


def paying(share: float, pays: float, noise: float = 0.0) -> Case:
    """One mind alone is paid, on a share of the layouts."""

    def draw(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
        return rng.normal(0, noise, shape), rng.normal(0, noise, shape) + pays * (rng.random(shape) < share)

    return Case(draw, share * pays)


def jackpot(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
    """100 on one layout in a hundred, 0.1 on 30 % of the others."""
    some = np.where(rng.random(shape) < 0.3, 0.1, 0.0)
    return np.zeros(shape), np.where(rng.random(shape) < 0.01, 100.0, some)


def normal(correlation: float) -> Case:
    """Scores as most are."""

    def draw(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
        first = rng.normal(0, 3, shape)
        return 10 + first, 11 + correlation * first + sqrt(1 - correlation**2) * rng.normal(0, 3, shape)

    return Case(draw, 1.0)


def succeeding(first: float, second: float) -> Case:
    """Each succeeds with a probability of its own."""
    return Case(
        lambda rng, shape: ((rng.random(shape) < first) * 1.0, (rng.random(shape) < second) * 1.0), second - first
    )


def bimodal(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
    """Nothing or 20: the second gets there on 60 % of the layouts, the first on half of them."""
    both = [np.where(rng.random(shape) < share, 20.0, 0.0) + rng.normal(0, 1, shape) for share in (0.5, 0.6)]
    return both[0], both[1]


def tied(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
    """Counts that are equal on 70 % of the layouts, and one more for the second on the others."""
    first = rng.poisson(3.0, shape).astype(float)
    return first, first + (rng.random(shape) < 0.3)


CASES = {
    "collapses on 2 %": collapsing(0.02),
    "collapses on 0.5 %": collapsing(0.005),
    "collapses on 10 %": collapsing(0.1),
    "alone solves 3 %, 0 or 100": paying(0.03, 100.0),
    "alone solves 3 %, 0 or 100, and noise": paying(0.03, 100.0, NOISE_STD),
    "alone solves 20 %, 0 or 100, and noise": paying(0.2, 100.0, NOISE_STD),
    "jackpot of 100 on 1 %, 0.1 on 30 %": Case(jackpot, 1.0 + 0.99 * 0.03),
    "lognormal, σ 2": Case(lambda rng, shape: (np.zeros(shape), rng.lognormal(0, 2, shape)), exp(2)),
    "lognormal, σ 1": Case(lambda rng, shape: (np.zeros(shape), rng.lognormal(0, 1, shape)), exp(0.5)),
    "normal, correlation 0": normal(0.0),
    "normal, correlation 0.5": normal(0.5),
    "normal, correlation 0.95": normal(0.95),
    "Student's t of 3": Case(lambda rng, shape: (rng.standard_t(3, shape), rng.standard_t(3, shape) + 1), 1.0),
    "exponential": Case(lambda rng, shape: (rng.exponential(1, shape), rng.exponential(1.5, shape)), 0.5),
    "counts": Case(lambda rng, shape: (rng.poisson(2.0, shape) * 1.0, rng.poisson(2.3, shape) * 1.0), 0.3),
    "counts, most of them the same": Case(tied, 0.3),
    "success 90 and 95 %": succeeding(0.9, 0.95),
    "success 0 and 3 %": succeeding(0.0, 0.03),
    "success 2 % each": succeeding(0.02, 0.02),
    "exponential on 3 %, else the same": Case(
        lambda rng, shape: (np.zeros(shape), rng.exponential(1, shape) * (rng.random(shape) < 0.03)), 0.03
    ),
    "nothing or 20": Case(bimodal, 2.0),
}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--minds", action="store_true", help="pairs of shipped minds instead")
    parser.add_argument("--comparisons", type=int, default=COMPARISONS_DRAWN)
    options = parser.parse_args()
    cases = {task: resampled(task) for task in PAIRS} if options.minds else CASES
    for name, case in cases.items():
        print(f"{name}: the difference is {case.truth:.4g}\n{HEAD}")
        for runs in RUNS_COMPARED:
            print(row(case, runs, options.comparisons), flush=True)


def resampled(task: str) -> Case:
    """Two minds on so many layouts, which stand for all."""
    first, second = (_scores(*mind, task) for mind in PAIRS[task])
    print(f"correlation {np.corrcoef(first, second)[0, 1]:.2f}")

    def draw(rng: Rng, shape: tuple[int, int]) -> tuple[Floats, Floats]:
        drawn = rng.integers(len(first), size=shape)
        return first[drawn], second[drawn]

    return Case(draw, float((second - first).mean()))


def row(case: Case, runs: int, comparisons: int) -> str:
    """A line of the table: how often the interval of so many runs contains the truth, and what else is said of it."""
    first, second = case.draw(np.random.default_rng(runs), (comparisons, runs))
    found = [difference(*both) for both in zip(first.astype(float), second.astype(float), strict=True)]
    told = [each for each in found if each.low is not None and each.high is not None]
    widened = np.mean([each.is_widened for each in found])
    line = f"  {runs:5}  " + " " * 25 + f"  {1 - len(told) / len(found):6.1%}  {widened:6.1%}"
    if not told:
        return line
    low, high = np.array([(each.low, each.high) for each in told], float).T
    mean, error = np.array([(each.mean, each.standard_error) for each in told], float).T
    half = t_quantile(runs - 1) * error
    ours = np.mean((low <= case.truth) & (case.truth <= high))
    student = np.mean(np.abs(mean - case.truth) <= half)
    width = np.median((high - low)[half > 0] / (2 * half[half > 0]))
    return f"  {runs:5}  {ours:7.1%}  {student:7.1%}  {width:7.2f}" + line[33:]


def _scores(file: str, master: str, task: str) -> Floats:
    """What a mind scores on each layout [LAYOUT_COUNT]."""
    setup = set_up(file, load(COLLECT / file), task, master)
    found: Floats = setup.rollout(workers=cores()).score(NO_GENOME, layouts(LAYOUT_SEED, LAYOUT_COUNT)).total[0]
    return found


if __name__ == "__main__":
    main()
