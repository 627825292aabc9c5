"""What flows through a hierarchy in one tick, for drawing: each link's command, and the influence it transmits."""

from dataclasses import dataclass

from mindrun.engine.engine import procedure_sources

from mindlang.run.edge_flow import Link as Link
from mindlang.run.edge_flow import Sink as Sink
from mindlang.run.edge_flow import edge_flows
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
        self._flows = edge_flows(run.setup.ready.policy, sources, run.setup.master, run)
        self.skills, self.links = self._flows.skills, self._flows.links

    def at(self, tick: int) -> list[Flowing]:
        """What each link carried in a tick, in the order of `links`."""
        found = self._flows.over(range(tick - 1, tick))
        return [Flowing(*both) for both in zip(found.value[0].tolist(), found.transmitted[0].tolist(), strict=True)]
