"""Genomes to be scored on seeds as a frame, and the scores that answer it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.train.population import Genomes
from mindrun.train.seeds import Seeds
from mindrun.work.frame import Frame, FrameError

SCORE, SCORES = "score", "scores"
COUNTED = ("counts", "by_event", "ticks", "ended_by", "met", "faults")
SUMMED = ("total", "by_line")
DIMENSIONS = {"by_event": 3, "by_line": 3}  # of those that have more than genomes and seeds


@dataclass(frozen=True, slots=True)
class WorkedScores:
    """The scores of `mindrun.sim.rollout.Scores`, as a worker has sent them: arrays [genomes, seeds, …]."""

    total: NDArray[np.float64]
    by_line: NDArray[np.float64]
    counts: NDArray[np.int64]
    by_event: NDArray[np.int64]
    ticks: NDArray[np.int64]
    ended_by: NDArray[np.int64]
    met: NDArray[np.int64]
    faults: NDArray[np.int64]


def score_frame(genomes: Genomes, seeds: Seeds, about: Mapping[str, Any]) -> Frame:
    """Every genome on every seed, as a frame; `about` is what else a job says."""
    return Frame(SCORE, about, {"genomes": genomes, "seeds": seeds})


def work_of(frame: Frame) -> tuple[Genomes, Seeds]:
    """The genomes and seeds of a frame; FrameError where it has none."""
    genomes, seeds = frame.arrays.get("genomes"), frame.arrays.get("seeds")
    if genomes is None or seeds is None or genomes.dtype != np.float32 or seeds.dtype != np.uint64:
        raise FrameError("it has no genomes, or no seeds")
    if (genomes.ndim, seeds.ndim) != (2, 1) or not np.isfinite(genomes).all():
        raise FrameError("its genomes are not whole, or its seeds")
    return genomes, seeds


def scores_frame(scores: Any) -> Frame:
    """Scores as a frame."""
    return Frame(SCORES, {}, {name: getattr(scores, name) for name in (*SUMMED, *COUNTED)})


def scores_of(frame: Frame, genomes: int, seeds: int) -> WorkedScores:
    """The scores of so many genomes on so many seeds; FrameError where a frame has others."""
    arrays = frame.arrays
    if frame.kind != SCORES or arrays.keys() != {*SUMMED, *COUNTED}:
        raise FrameError("it has other arrays than scores")
    for name, array in arrays.items():
        kind = np.float64 if name in SUMMED else np.int64
        if array.dtype != kind or array.shape[:2] != (genomes, seeds) or array.ndim != DIMENSIONS.get(name, 2):
            raise FrameError(f"its {name} are not of {genomes} genomes on {seeds} seeds")
    if np.isnan(arrays["total"]).any() or (arrays["ticks"] < 0).any():
        raise FrameError("its scores are no numbers")
    return WorkedScores(**arrays)
