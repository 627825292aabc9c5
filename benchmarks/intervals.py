"""How often the interval of `mindc bench A B` contains the true difference: python benchmarks/intervals.py [RUNS].

Pairs of minds of examples/collect run on RUNS common layouts (default: 10,000), whose mean difference stands for the
true one. Comparisons of 20 to 1,000 of these runs are drawn from them with replacement; of each kind of interval,
the share that contains it, and how wide it is beside Student's of the pairs.
"""

import sys
from collections.abc import Callable
from math import sqrt
from pathlib import Path

import numpy as np
from mindrun.sim.rollout import cores
from numpy.typing import NDArray

from mindlang.compiler.compile import load
from mindlang.run.layouts import NO_GENOME, layouts
from mindlang.run.paired_difference import difference, t_quantile
from mindlang.run.setup import set_up

Floats = NDArray[np.float64]
Intervals = Callable[[Floats, Floats, np.random.Generator], tuple[Floats, Floats]]  # of scores [comparisons, runs]
COLLECT = Path(__file__).resolve().parent.parent / "examples" / "collect"
PAIRS = {  # task: two minds, each with its master
    "Collect": (("collect.mind", "Collect"), ("best.mind", "Deliver")),
    "GoToObject": (("collect.mind", "GoToObject"), ("collect.mind", "Collect")),
    "Avoid": (("collect.mind", "Avoid"), ("best.mind", "Avoid")),
}
RUNS_COMPARED = 20, 50, 200, 1000
COMPARISONS_DRAWN, RESAMPLED_MEANS = 2000, 1000
LAYOUT_SEED = 17


def main() -> None:
    """Measure and print."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    for task, minds in PAIRS.items():
        first, second = (scores(*mind, task, runs) for mind in minds)
        correlation = np.corrcoef(first, second)[0, 1]
        print(f"{task}: {runs:,} pairs, difference {(second - first).mean():.3g}, correlation {correlation:.2f}")
        for compared in RUNS_COMPARED:
            print(f"  {compared:3} runs  " + ", ".join(coverage(first, second, compared)))


def scores(file: str, master: str, task: str, runs: int) -> Floats:
    """What a mind scores on each layout [runs]."""
    setup = set_up(file, load(COLLECT / file), task, master)
    found: Floats = setup.rollout(workers=cores()).score(NO_GENOME, layouts(LAYOUT_SEED, runs)).total[0]
    return found


def coverage(first: Floats, second: Floats, runs: int) -> list[str]:
    """Of each kind of interval, how often it contains the mean difference, and how wide it is."""
    rng = np.random.default_rng(runs)
    drawn = rng.integers(len(first), size=(COMPARISONS_DRAWN, runs))
    truth = (second - first).mean()
    found = {name: of(first[drawn], second[drawn], rng) for name, of in KINDS.items()}
    width = np.mean(np.subtract(*found["Student"][::-1]))
    return [
        f"{name} {np.mean((low <= truth) & (truth <= high)):.1%} ({np.mean(high - low) / width:.2f})"
        for name, (low, high) in found.items()
    ]


def _ours(first: Floats, second: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """What `mindc bench A B` says."""
    found = [difference(*both) for both in zip(first, second, strict=True)]
    return np.array([each.low for each in found]), np.array([each.high for each in found])


def _student(first: Floats, second: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    return _around((second - first).mean(axis=1), (second - first).std(axis=1, ddof=1), first.shape[1])


def _unpaired(first: Floats, second: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    spread = np.hypot(first.std(axis=1, ddof=1), second.std(axis=1, ddof=1))
    return _around(second.mean(axis=1) - first.mean(axis=1), spread, first.shape[1])


def _bootstrap(first: Floats, second: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Percentiles of the means of resampled differences."""
    each, runs = second - first, first.shape[1]
    means = (row[rng.integers(runs, size=(RESAMPLED_MEANS, runs))].mean(axis=1) for row in each)
    bounds = [np.percentile(mean, [2.5, 97.5]) for mean in means]
    return np.array(bounds)[:, 0], np.array(bounds)[:, 1]


def _around(mean: Floats, spread: Floats, runs: int) -> tuple[Floats, Floats]:
    half = t_quantile(runs - 1) * spread / sqrt(runs)
    return mean - half, mean + half


KINDS: dict[str, Intervals] = {"ours": _ours, "Student": _student, "bootstrap": _bootstrap, "unpaired": _unpaired}

if __name__ == "__main__":
    main()
