"""What flows through a hierarchy in one tick, for drawing: each link's command, and the influence it transmits."""

from dataclasses import dataclass

import numpy as np
from mindrun.engine import procedure_sources

from mindlang.run.edge_flow import EdgeFlows
from mindlang.run.edge_flow import Link as Link
from mindlang.run.edge_flow import Sink as Sink
from mindlang.run.recorded_run import RecordedRun


@dataclass(frozen=True, slots=True)
class Flowing:
    """What a link carries in one tick, both 0..1: what its skill commands, and the influence behind it."""

    command: float
    transmitted: float


class Flow:
    """The links of the skills that a run's master reaches, and what they carry."""

    def __init__(self, run: RecordedRun) -> None:
        sources = procedure_sources(run.graph, run.setup.folder, run.setup.master)
        self._flows = EdgeFlows(run.setup.ready.policy, sources, run.setup.master, run)
        self.skills, self.links = self._flows.skills, self._flows.links
        self._drives = np.array([link.target[0] != "skill" for link in self.links], bool)

    def at(self, tick: int) -> list[Flowing]:
        """What each link carried in a tick, in the order of `links`."""
        found = self._flows.at(tick - 1)
        transmitted = np.where(self._drives, found.behind, found.carried)
        return [Flowing(*both) for both in zip(found.value.tolist(), transmitted.tolist(), strict=True)]
