"""The difference of two minds over runs that began on the same layouts, and what that says of all layouts.

Runs on one layout share what is easy or hard about it, so the difference of each pair varies less than two means do.
The interval is Student's for the mean of the differences d of n runs, mean ± t · std(d) / √n, but

- where they are skewed it goes as far to either side as that of Hall (1992), who takes the skewness out of t;
- to neither side it ends before what layouts can do of which no run is an example. With 95 % confidence these are no
  more than the share 1 − 0.05^(1/n) of all; on them either mind can be as far from the mean as any score that was
  seen, at the distance D: mean ± share · D.

What no score has shown, it does not contain: layouts rarer than one in 1 / share that bring more than any run did.
"""

from dataclasses import dataclass
from functools import cache
from math import atan, ceil, exp, lgamma, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

CONFIDENCE_LEVEL = 0.95  # of intervals: so many of them, of so many comparisons, contain the difference
NORMAL_TWO_SIDED, NORMAL_POWER = 1.9600, 0.8416  # quantiles of the normal distribution: 97.5 %, and 80 %
MIN_RUNS, MAX_RUNS = 2, 10_000_000  # that have a standard error, and that `mindc bench` takes
MAX_QUANTILE, QUADRATURE_NODES, MAX_BISECTIONS = 13.0, 64, 60
REACH_OF_OTHER_RUNS = 1.2  # times as far as those that were seen
BEND_TOLERANCE = 1e-9  # from which on skewness bends an interval


@dataclass(frozen=True, slots=True)
class PairedDifference:
    """The second less the first, over `runs` pairs, of which in `more` it was more, in `less` less, in `equal` neither.

    `low` to `high` is the 95 % confidence interval of the mean; None of a single pair, and where no pair differs.
    It is never narrower than `unseen` to both sides: what layouts of which no run need be an example, up to the share
    `most_that_differ` of all, could do to the mean within the scores that were seen.
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
    unseen: float | None = None
    detectable: float | None = None
    runs_to_tell: int | None = None

    @property
    def differing(self) -> int:
        return self.more + self.less

    @property
    def leaves_zero_out(self) -> bool:
        return self.low is not None and self.high is not None and not self.low <= 0 <= self.high

    @property
    def most_that_differ(self) -> float:
        """The largest share of layouts of which no run need be an example, with 95 % confidence."""
        return unseen_share(self.runs)

    @property
    def is_widened(self) -> bool:
        """True if layouts without an example make the interval as wide as it is."""
        if self.mean is None or self.unseen is None:
            return False
        return self.low == self.mean - self.unseen or self.high == self.mean + self.unseen


def difference(first: NDArray[np.float64], second: NDArray[np.float64]) -> PairedDifference:
    """The difference of two minds, of what each came to in each run [runs]."""
    finite = np.isfinite(first) & np.isfinite(second)
    with np.errstate(invalid="ignore"):  # −∞ less −∞
        each = np.asarray(second, np.float64) - np.asarray(first, np.float64)
    runs = len(each)
    told = each[finite]
    counts = runs, int((told > 0).sum()), int((told < 0).sum()), int((told == 0).sum()), runs - len(told)
    if not finite.all():
        return PairedDifference(*counts)
    mean = float(each.mean())
    if runs < MIN_RUNS:
        return PairedDifference(*counts, mean)
    std = float(each.std(ddof=1))
    error = std / sqrt(runs)
    if counts[1] + counts[2] == 0:
        return PairedDifference(*counts, mean, std, error)
    means = float(first.mean()), float(second.mean())
    most, least = max(first.max(), second.max()), min(first.min(), second.min())
    farthest = float(max(most - min(means), max(means) - least))  # any run of both minds from the mean of either
    unseen = unseen_share(runs) * farthest
    below, above = _sides(each, mean, std)
    low, high = mean - max(below, unseen), mean + max(above, unseen)
    detectable = max(NORMAL_TWO_SIDED * error, unseen) + NORMAL_POWER * error
    needed = _runs_to_tell(abs(mean), std, farthest)
    return PairedDifference(*counts, mean, std, error, low, high, unseen, detectable, needed)


def _sides(each: NDArray[np.float64], mean: float, std: float) -> tuple[float, float]:
    """The lengths of the interval below and above the mean of differences of this std, for what the runs show.

    Of the skewness γ: t' = t + a t² + a² t³ / 3 + a / 2, a = γ / (3 √n), whose inverse is in closed form.
    """
    runs = len(each)
    half, error = t_quantile(runs - 1), std / sqrt(runs)
    scale = float(np.sqrt(np.mean((each - mean) ** 2)))
    bend = float(np.mean(((each - mean) / scale) ** 3)) / (3 * sqrt(runs)) if scale else 0.0
    if abs(bend) < BEND_TOLERANCE:
        return half * error, half * error
    ends = [float(np.cbrt(1 + 3 * bend * (end - bend / 2)) - 1) / bend for end in (half, -half)]
    return max(half, ends[0]) * error, max(half, -ends[1]) * error


def unseen_share(runs: int) -> float:
    """The largest share of layouts of which so many runs may have no example, with 95 % confidence."""
    return float(1 - (1 - CONFIDENCE_LEVEL) ** (1 / runs))


@cache
def t_quantile(degrees: int) -> float:
    """The number of standard errors about a mean that hold 95 % of Student's distribution with ν degrees.

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


def _runs_to_tell(mean: float, std: float, farthest: float) -> int | None:
    """The runs that it takes until the mean is as far from 0 as half the interval and what 80 % of the means vary.

    The share without an example is at most −ln(0.05) / n: a quadratic equation in 1 / √n.
    """
    if not mean:
        return None
    unseen, varies = -log(1 - CONFIDENCE_LEVEL) * REACH_OF_OTHER_RUNS * farthest, NORMAL_POWER * std
    roots = [(NORMAL_TWO_SIDED + NORMAL_POWER) * std / mean]
    roots.append((varies + sqrt(varies**2 + 4 * unseen * mean)) / (2 * mean))
    runs = max(roots) * max(roots)  # ∞ where ** would raise
    return max(ceil(runs), MIN_RUNS) if runs <= MAX_RUNS else None
