"""How much two minds differ over runs that began on the same layouts, and what that says of all layouts.

Runs on one layout share what is easy or hard about it, so the difference of each pair varies less than two means do.
The interval is Student's for the mean of the differences d of n runs: mean ± t · std(d) / √n.
"""

from dataclasses import asdict, dataclass
from math import atan, ceil, exp, isfinite, lgamma, pi, sqrt

import numpy as np
from numpy.typing import NDArray

CONFIDENCE_LEVEL = 0.95  # of intervals: so many of them, of so many comparisons, contain the difference
NORMAL_TWO_SIDED, NORMAL_POWER = 1.9600, 0.8416  # quantiles of the normal distribution: 97.5 %, and 80 %
MIN_DIFFERING_RUNS = 10  # runs: with fewer, the mean of the differences is far from normal
MAX_RUNS = 10_000_000  # that `mindc bench` takes
MAX_QUANTILE, QUADRATURE_NODES, MAX_BISECTIONS = 13.0, 64, 60


@dataclass(frozen=True, slots=True)
class Difference:
    """The second less the first, over `runs` pairs, of which in `more` it was more, in `less` less, in `equal` neither.

    `low` to `high` is the 95 % confidence interval of the mean; None where fewer than MIN_DIFFERING_RUNS pairs differ.
    `detectable` is the difference that so many runs would tell from 0 four times in five, and `runs_to_tell` how many
    it would take if the true difference were `mean`; None beyond MAX_RUNS. All are None where a figure is not finite,
    in `not_finite` pairs.
    """

    runs: int
    more: int
    less: int
    equal: int
    not_finite: int
    mean: float | None = None
    std: float | None = None
    standard_error: float | None = None
    low: float | None = None
    high: float | None = None
    detectable: float | None = None
    runs_to_tell: int | None = None

    @property
    def differing(self) -> int:
        """How many runs came to something else."""
        return self.more + self.less

    @property
    def leaves_zero_out(self) -> bool:
        """Whether the interval leaves 0 out."""
        return self.low is not None and self.high is not None and not self.low <= 0 <= self.high

    @property
    def most_that_differ(self) -> float:
        """Where no run differs: the largest share of layouts on which they could, with 95 % confidence."""
        return float(1 - (1 - CONFIDENCE_LEVEL) ** (1 / self.runs))

    def data(self) -> dict[str, float | int | None]:
        """As plain data."""
        return asdict(self)


def difference(first: NDArray[np.float64], second: NDArray[np.float64]) -> Difference:
    """The difference of two minds, of what each came to in each run [runs]."""
    finite = np.isfinite(first) & np.isfinite(second)
    with np.errstate(invalid="ignore"):  # −∞ less −∞
        each = np.asarray(second, np.float64) - np.asarray(first, np.float64)
    runs = len(each)
    counts = runs, int((each > 0).sum()), int((each < 0).sum()), int((each == 0).sum()), int((~finite).sum())
    if not finite.all():
        return Difference(*counts)
    mean = float(each.mean())
    if runs < 2:
        return Difference(*counts, mean)
    std = float(each.std(ddof=1))
    error = std / sqrt(runs)
    if counts[1] + counts[2] < MIN_DIFFERING_RUNS:
        return Difference(*counts, mean, std, error)
    half, needed = t_quantile(runs - 1) * error, NORMAL_TWO_SIDED + NORMAL_POWER
    return Difference(
        *counts, mean, std, error, mean - half, mean + half, needed * error, _runs_to_tell(mean, needed * std)
    )


def t_quantile(degrees: int) -> float:
    """How many standard errors to both sides of a mean are 95 % of Student's distribution with so many degrees ν.

    P(|t| < b) = 2 Γ((ν+1)/2) / (√π Γ(ν/2)) ∫ cos^(ν−1) from 0 to arctan(b / √ν), by Gauss and Legendre.
    """
    nodes, weights = np.polynomial.legendre.leggauss(QUADRATURE_NODES)
    scale = 2 * exp(lgamma((degrees + 1) / 2) - lgamma(degrees / 2)) / sqrt(pi)
    low, high = 0.0, MAX_QUANTILE
    for _ in range(MAX_BISECTIONS):
        middle = (low + high) / 2
        half = atan(middle / sqrt(degrees)) / 2
        within = scale * half * float(weights @ np.cos(half * (nodes + 1)) ** (degrees - 1))
        low, high = (middle, high) if within < CONFIDENCE_LEVEL else (low, middle)
    return (low + high) / 2


def _runs_to_tell(mean: float, spread: float) -> int | None:
    runs = (spread / mean) ** 2 if mean and isfinite(spread / mean) else MAX_RUNS + 1
    return max(ceil(runs), MIN_DIFFERING_RUNS) if runs <= MAX_RUNS else None
