"""Lanes whose robots are commanded from outside: for drivers and learners that are no part of the product."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.kinds.functions.function import Rule
from mindrun.sim.lanes.advance import after, before
from mindrun.sim.rollout import Rollout
from numpy.typing import ArrayLike


class Commanded:
    """A task in so many lanes, each with the next of the seeds when its run ends; `interrupt` as in Rollout."""

    def __init__(self, graph: Graph, task: str, master: str, lanes: int, seeds: ArrayLike, interrupt: bool) -> None:
        silent = replace(graph, skills=tuple(replace(skill, function=Rule()) for skill in graph.skills))
        rollout = Rollout(Policy(silent, {}), task, master, interrupt=interrupt)
        self.lanes, self.boxes = lanes, rollout.sizes["boxes"]
        self.jobs = rollout.jobs(np.zeros((1, 0), np.float32), np.asarray(seeds, np.uint64))
        self._tables, self._tile, self._interrupt = rollout.tables, rollout.tile(lanes), interrupt
        self.state = self._tile.state
        rollout.compile()
        rollout.fill(self._tile, self.jobs)
        before(self._tables, self.state, self.jobs)

    def step(self, actuators: Sequence[int], commands: ArrayLike) -> None:
        """One tick: commands [actuators, lanes] in 0..1 for these actuators, the others stay neutral."""
        state, mind = self.state, self.state.mind
        mind.command_sums[:] = mind.influence_sums[:] = 0
        for actuator, row in zip(actuators, np.asarray(commands), strict=True):
            mind.command_sums[actuator, : self.lanes], mind.influence_sums[actuator, : self.lanes] = row, 1
        after(self._tables, state, self.jobs, self._interrupt)

    def sense(self) -> None:
        """What the robots read now; to be called before the next step."""
        before(self._tables, self.state, self.jobs)
