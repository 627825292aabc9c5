"""Episodes side by side: what an agent sees, is paid and is told, as arrays."""

from pathlib import Path
from typing import Any

import numpy as np
from mindrun.errors import MindError
from mindrun.sim.commanded_world import ended_by
from mindrun.sim.state import State
from numpy.typing import ArrayLike, NDArray

from mindlang.environments.agent import agent_of

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
SEED_COUNT = 1 << 64  # layouts
REAL_NUMBERS = "biuf"  # kinds of arrays: truth values, whole numbers, others
MAX_DRAWN_SEED = 1 << 63  # so many that no two episodes are drawn the same


class Episodes:
    """So many runs of a task, each with an agent (`agent_of`) of its own."""

    def __init__(self, file: Path, task: str | None, master: str | None, skill: str | None, lanes: int) -> None:
        self.agent = agent_of(file, task, master, skill, lanes)
        self._lanes = self.agent.lanes
        self._shape = (lanes, self.agent.actions)
        self.seeds = np.zeros(lanes, np.uint64)
        self._scores = np.zeros(lanes)

    def begin(self, lanes: Mask, seeds: ArrayLike) -> None:
        """Begin the runs of these layouts in the marked lanes; to be followed by `sense`."""
        self.seeds[lanes] = seeds
        self._lanes.begin(lanes, seeds)
        self._scores[lanes] = 0.0

    def sense(self) -> Floats:
        """What every agent sees [lanes, readings]; once in each tick."""
        self._lanes.sense()
        return self._seen(self._lanes.state, self._shape[0])

    def last_seen(self, lanes: Mask) -> Floats:
        """What the agents of the marked lanes see, where another run is about to begin; `sense` is not disturbed."""
        return self._seen(self._lanes.sensed_aside(lanes), int(lanes.sum()))

    def step(self, actions: ArrayLike) -> tuple[NDArray[np.float64], Mask, Mask]:
        """One tick under actions [lanes, actions]: rewards, what has come to an end, and where time is up instead."""
        self.agent.act(numbers(actions, self._shape))
        scores = self._lanes.scores
        rewards, self._scores = scores - self._scores, scores
        terminated = self._lanes.terminated
        return rewards, terminated, self._lanes.timed_out & ~terminated

    def outcome(self, lane: int) -> dict[str, Any]:
        """What is said of a run that has ended: as numbers what `mindc run` says; a `count` where one is kept."""
        task, lanes = self.agent.setup.task, self._lanes
        return {
            "layout": int(self.seeds[lane]),
            "score": float(lanes.scores[lane]),
            **({"count": int(lanes.counts[lane, list(task.counts)].sum())} if task.counts else {}),
            "ended_by": ended_by(task, int(lanes.ended_by[lane])),
        }

    def _seen(self, state: State, lanes: int) -> Floats:
        return np.ascontiguousarray(state.mind.readings[self.agent.readings, :lanes].T)


def numbers(actions: ArrayLike, shape: tuple[int, ...]) -> Floats:
    """Actions as they are given to robots; MindError where they are no numbers of that shape."""
    try:
        given = np.asarray(actions)
    except ValueError as error:  # lists of several lengths
        raise MindError(f"actions are no array: {error}", f"give an array of the shape {shape}") from error
    if given.dtype.kind not in REAL_NUMBERS:
        raise MindError(f"actions are of {given.dtype}, which are no real numbers", f"give float32 {shape}")
    if given.shape != shape:
        raise MindError(f"actions have the shape {given.shape}", f"{shape} is what the action space says")
    if given.dtype != np.float32:  # what is finite stays so: it will be clamped
        given = np.where(np.isfinite(given), np.clip(given, 0.0, 1.0), given)
    return given.astype(np.float32, copy=False)


def layouts(seeds: list[int | None], streams: list[np.random.Generator]) -> NDArray[np.uint64]:
    """The layout of each seed, that of `mindc run --seed`; drawn from its stream where there is none."""
    drawn = (
        int(stream.integers(MAX_DRAWN_SEED)) if seed is None else seed % SEED_COUNT
        for seed, stream in zip(seeds, streams, strict=True)
    )
    return np.array([*drawn], np.uint64)
