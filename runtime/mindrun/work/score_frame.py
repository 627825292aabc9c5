"""Genomes to be scored on seeds as a frame, and the scores that answer it."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores
from mindrun.train.population import Genomes
from mindrun.train.seeds import Seeds
from mindrun.work.frame import Arrays, Frame, FrameError

SCORE, SCORES = "score", "scores"
COUNTED = ("counts", "by_event", "ticks", "ended_by", "met", "faults")
SUMMED = ("total", "by_line")
MIN_END = -8  # numbers of what ends a run and is no end of the task are from here to -1


def score_frame(genomes: Genomes, seeds: Seeds, about: Mapping[str, Any]) -> Frame:
    """Every genome on every seed, as a frame; `about` is what else a job says."""
    return Frame(SCORE, about, {"genomes": genomes, "seeds": seeds})


def work_of(frame: Frame, length: int) -> tuple[Genomes, Seeds]:
    """The genomes of so many weights and the seeds of a frame; FrameError where it has none."""
    genomes, seeds = frame.arrays.get("genomes"), frame.arrays.get("seeds")
    if genomes is None or seeds is None or genomes.dtype != np.float32 or seeds.dtype != np.uint64:
        raise FrameError("it has no genomes, or no seeds")
    if (genomes.ndim, seeds.ndim) != (2, 1) or not np.isfinite(genomes).all():
        raise FrameError("its genomes are not whole, or its seeds")
    if genomes.shape[1] != length:
        raise FrameError(f"its genomes have no {length} weights")
    return genomes, seeds


def scores_frame(scores: Any) -> Frame:
    """Scores as a frame."""
    return Frame(SCORES, {}, {name: getattr(scores, name) for name in (*SUMMED, *COUNTED)})


def scores_of(frame: Frame, genomes: int, seeds: int, task: Task) -> Scores:
    """The scores of so many genomes on so many seeds of a task; FrameError where a frame has others."""
    arrays = frame.arrays
    if frame.kind != SCORES or arrays.keys() != {*SUMMED, *COUNTED}:
        raise FrameError("it has other arrays than scores")
    for name, array in arrays.items():
        if array.dtype != kind_of(name) or array.shape != shape_of(name, genomes, seeds, task):
            raise FrameError(f"its {name} are not of {genomes} genomes on {seeds} seeds")
    if np.isnan(arrays["total"]).any() or not all(_could_be(arrays, task)):
        raise FrameError("its scores are such as no run has")
    return Scores(**arrays)


def kind_of(name: str) -> type[np.float64 | np.int64]:
    """Of which numbers an array is."""
    return np.float64 if name in SUMMED else np.int64


def shape_of(name: str, genomes: int, seeds: int, task: Task) -> tuple[int, ...]:
    """How large an array is."""
    more = {"by_line": (max(1, len(task.rewards)),), "by_event": (len(task.events),)}
    return (genomes, seeds, *more.get(name, ()))


def _could_be(arrays: Arrays, task: Task) -> Iterator[bool]:
    """Whether each count is one that a run of the task could have."""
    for name in ("counts", "by_event", "ticks", "faults"):
        yield bool((arrays[name] >= 0).all())
    yield bool((arrays["ticks"] <= task.ticks).all())
    for name in ("ended_by", "met"):
        yield bool((arrays[name] < len(task.ends)).all()) and bool((arrays[name] >= MIN_END).all())
