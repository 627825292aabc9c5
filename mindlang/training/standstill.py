"""Where attempts stood still: the ticks after which their champions became no better, beyond their noise."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from mindlang.number_format import tick_count

IDLE_SHARE = 0.5  # of the ticks of a log, from which on it is said that they brought nothing
FEWEST_SCORES, END_SCORES = 10, 3  # re-evaluations without which nothing can be said; so many at either end
GAIN_SIGMAS = 2.0  # standard errors, beyond which a gain is one
NOISE_OF_MEDIAN = 1.4826 / 2**0.5  # times the median difference of two scores: their standard deviation

Records = Sequence[Mapping[str, float | None]]  # the generations of a log, attempt by attempt


def idle_ticks(records: Records) -> int:
    """The ticks of a log, of all its attempts, with which no champion became better."""
    idle = 0
    for _, attempt in groupby(records, key=lambda record: record["attempt"]):
        rows = [*attempt]
        scores = [(row["generation"] or 0, score) for row in rows if isfinite(score := _number(row, "reevaluated"))]
        begin = standstill(np.array([score for _, score in scores]))
        if begin is not None:
            ticks = [_number(row, "ticks") for row in rows if (row["generation"] or 0) > scores[begin][0]]
            idle += sum(int(each) for each in ticks if isfinite(each))
    return idle


def idle_note(records: Records) -> str:
    """A sentence on ticks that brought nothing, where these are half of all or more; else empty."""
    idle, ticks = idle_ticks(records), sum(int(record.get("ticks") or 0) for record in records)
    if idle <= IDLE_SHARE * ticks:
        return ""
    return (
        f"{tick_count(idle)} of {tick_count(ticks)} ticks brought nothing: on fresh layouts no champion became better "
        "beyond its noise; fewer generations, or patience, would do"
    )


def standstill(scores: NDArray[np.float64]) -> int | None:
    """The first of an attempt's re-evaluations behind which nothing rises; None where they are few, or always do.

    Behind it neither the later half is better than the one before, nor the rest than its first three, nor the last
    three than what is before them. The noise is that of scores which follow each other.
    """
    if len(scores) < FEWEST_SCORES:
        return None
    noise = NOISE_OF_MEDIAN * float(np.median(np.abs(np.diff(scores))))
    tails = (begin for begin in range(len(scores) - 2 * END_SCORES + 1) if not _rises(scores[begin:], noise))
    return next(tails, None)


def _rises(scores: NDArray[np.float64], noise: float) -> bool:
    count = len(scores)
    return any(
        scores[cut:].mean() - scores[:cut].mean() > GAIN_SIGMAS * noise * (1 / cut + 1 / (count - cut)) ** 0.5
        for cut in (END_SCORES, count // 2, count - END_SCORES)
    )


def _number(record: Mapping[str, float | None], column: str) -> float:
    value = record.get(column)
    return float("nan") if value is None else value
