"""How often nothing influenced an actuator in a run of the simulator."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import joined, trace

from mindlang.run.setup import RunSetup


@dataclass(frozen=True, slots=True)
class Undriven:
    """The ticks in which nothing influenced an actuator, the first of them (from 1), and the commands it was sent."""

    ticks: int
    first: int | None
    commands: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Recorded:
    """A run: what it was, and what became of each actuator. `faults` counts values that were not sent."""

    task: str
    seed: int
    ticks: int
    faults: int
    actuators: tuple[Undriven, ...]


def record(setup: RunSetup, seed: int, prepare: Callable[[Rollout], None] = Rollout.compile) -> Recorded:
    """One run to its end; `prepare` compiles the simulator. Runs the Python code of the mind's procedures."""
    rollout = setup.rollout()
    prepare(rollout)
    run = trace(rollout, seed)
    ticks = joined(run.chunks)
    reached = rollout.tables.skills["index"]
    total = ticks.influence[:, reached] @ _drivers(rollout)[reached]
    actuators = (_undriven(total[:, place], ticks.commands[:, place]) for place in range(total.shape[1]))
    return Recorded(setup.task.name, seed, len(ticks), int(run.jobs.faults[0]), tuple(actuators))


def _drivers(rollout: Rollout) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
    """1 where a skill drives an actuator [skills, actuators]."""
    graph = rollout.graph
    drives = np.zeros((len(graph.skills), len(graph.actuators)), np.float32)
    for place, skill in enumerate(graph.skills):
        for edge in skill.edges:
            if edge.to == "actuator":
                drives[place, edge.target] = 1
    return drives


def _undriven(
    total: np.ndarray[tuple[int], np.dtype[np.float32]], commands: np.ndarray[tuple[int], np.dtype[np.float32]]
) -> Undriven:
    still = np.flatnonzero(total == 0)
    return Undriven(
        len(still), int(still[0]) + 1 if len(still) else None, (float(commands.min()), float(commands.max()))
    )
