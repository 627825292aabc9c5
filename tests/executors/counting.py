"""A scorer whose results are plain arithmetic of a genome and a seed, with all that a rollout's have; and executors."""

import pickle
from collections.abc import Iterable
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
from mindrun.graph.run_scores import Scores
from numpy.typing import NDArray

from mindlang.executors.jobs import Done, Work, answer

LENGTH, TICKS = 3, 100
TASK: Any = SimpleNamespace(
    name="Count", rewards=(None,) * 2, events=(None,) * 3, ends=(None,), ticks=TICKS, scene=None, can_succeed=False
)


class Counting:
    """Scores by arithmetic; `jobs` are how many runs each call was for, and it tallies them."""

    task, genome_length, notes = TASK, LENGTH, ()

    def __init__(self) -> None:
        self.jobs: list[int] = []
        self._tally = np.zeros(2, np.int64)

    def draw(self, count: int, rng: np.random.Generator) -> NDArray[np.float32]:
        return rng.standard_normal((count, LENGTH), np.float32)

    def tally(self) -> NDArray[np.int64]:
        return self._tally.copy()

    def add(self, tally: NDArray[np.int64]) -> None:
        self._tally += tally

    def score(self, genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ticks: int | None = None) -> Scores:
        first = np.multiply.outer(genomes.astype(np.float64).sum(axis=1), np.sin(np.asarray(seeds, np.float64)))
        lines = np.stack([first, first**2], axis=-1)
        total = lines[..., 0] + lines[..., 1]
        words = np.abs(first * 1e3).astype(np.int64)
        events = np.stack([words % 5, words % 7, words % 11], axis=-1)
        self.jobs.append(total.size)
        self.add(np.array([total.size, int((words % 2).sum())]))
        ends = words % 4 - 3
        faults = (words % 13 == 0).astype(np.int64)
        return Scores(total, lines, events.sum(axis=-1), events, words % TICKS, ends, ends, faults)


@dataclass
class Shuffling:
    """An executor in this process: `choices` say which open job comes next, and what becomes of it.

    A number below 0 loses it (its worker has done it, and nobody hears of it), and it is done again later.
    """

    choices: Iterable[int]
    width: int = 2
    has_begun: bool = True
    jobs: list[tuple[int, Work]] = field(default_factory=list)
    scorer: Counting = field(default_factory=Counting)

    def __post_init__(self) -> None:
        self.choices = iter(self.choices)

    @property
    def workers(self) -> int:
        return self.width

    def has_room(self) -> bool:
        return len(self.jobs) < self.width

    def submit(self, number: int, work: Work) -> None:
        self.jobs.append((number, pickle.loads(pickle.dumps(work))))

    def next_result(self) -> tuple[int, Done] | None:
        choice = next(self.choices, 0)  # type: ignore[call-overload]
        if not self.jobs:
            return None
        number, work = self.jobs[choice % len(self.jobs)]
        found = answer(lambda: self.scorer, work)
        assert isinstance(found, Done), found
        if choice < 0:
            return None
        self.jobs = [job for job in self.jobs if job[0] != number]
        return number, pickle.loads(pickle.dumps(found))

    def close(self) -> None:
        self.jobs.clear()
