"""What flows through a hierarchy in one tick: each link's command alone, and the influence that it transmits."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

import numpy as np
from mindrun.engine import procedure_sources
from mindrun.graph import Receiver
from mindrun.think import hierarchy, values
from numpy.typing import NDArray

from mindlang.run.recorded_run import RecordedRun

Sink = tuple[Receiver, int]  # which one of its kind


@dataclass(frozen=True, slots=True)
class Link:
    """From a skill's index to a skill, an actuator or a memory."""

    source: int
    target: Sink


@dataclass(frozen=True, slots=True)
class Flowing:
    """What a link carries in one tick, both 0..1: what its skill commands, and the influence behind it."""

    command: float
    transmitted: float


class Flow:
    """The links of the skills that a run's master reaches, and what they carry."""

    def __init__(self, run: RecordedRun) -> None:
        graph = run.graph
        sources = procedure_sources(graph, run.setup.folder, run.setup.master)
        self._run = run
        self._hierarchy = hierarchy(run.setup.ready.policy, sources, run.setup.master)
        self.skills = [skill.index for skill in self._hierarchy.skills]
        self.links = [
            Link(index, (edge.to, edge.target)) for index in self.skills for edge in graph.skills[index].edges
        ]

    def at(self, tick: int) -> list[Flowing]:
        """What each link carried in a tick, in the order of `links`."""
        influence = self._run.influence[tick - 1]
        with np.errstate(all="ignore"):
            return list(self._flowing(self._run.readings[tick - 1], influence))

    def _flowing(self, readings: NDArray[np.float32], influence: NDArray[np.float32]) -> Iterator[Flowing]:
        for skill in self._hierarchy.skills:
            own = float(influence[skill.index])
            for sent, value in zip(skill.edges, values(skill, readings), strict=True):
                is_sent = value is not None and isfinite(value)
                command = min(1.0, max(0.0, float(value or 0.0))) if is_sent else 0.0
                passed = command * own
                yield Flowing(command, own * is_sent if sent.drives else passed * (passed >= sent.cuts))
