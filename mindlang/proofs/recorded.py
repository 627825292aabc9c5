"""Runs of the simulator beside a proof: how often nothing influenced an actuator."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mindrun.graph.scopes import influence_scopes
from mindrun.numbers.arrays import Singles
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import joined, trace

from mindlang.run.setup import RunSetup


@dataclass(frozen=True, slots=True)
class Undriven:
    """The ticks in which nothing influenced an actuator, the first of them (from 1), and the commands it was sent."""

    neutral_ticks: int
    first_tick: int | None
    commands: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Recorded:
    """A run: its task, seed and length, and each actuator's `Undriven`. `faults` counts values that were not sent."""

    task: str
    seed: int
    ticks: int
    faults: int
    actuators: tuple[Undriven, ...]


def record_undriven(setup: RunSetup, seed: int, prepare: Callable[[Rollout], None] = Rollout.compile) -> Recorded:
    """Simulate one run to its end; `prepare` compiles the simulator. Runs the Python code of the mind's procedures."""
    rollout = setup.rollout()
    prepare(rollout)
    run = trace(rollout, seed)
    ticks = joined(run.chunks)
    influence = np.zeros_like(ticks.commands)  # on each actuator
    graph = rollout.graph
    if len(influence_scopes(graph).without) > 1:
        flows = setup.flows(ticks)
        drivers = [(place, link.target[1]) for place, link in enumerate(flows.links) if link.target[0] == "actuator"]
        for part, flow in flows.parts(np.arange(len(ticks))):
            for place, actuator in drivers:
                influence[part, actuator] += flow.behind[:, place]
    else:
        for place in rollout.tables.skills["index"]:
            for edge in (each for each in graph.skills[place].edges if each.to == "actuator"):
                influence[:, edge.target] += ticks.influence[:, place]
    actuators = tuple(map(undriven, influence.T, ticks.commands.T))
    return Recorded(setup.task.name, seed, len(ticks), int(run.jobs.faults[0]), actuators)


def undriven(influence: Singles, commands: Singles) -> Undriven:
    """The ticks without influence on an actuator, the first of them, and its range of commands; arrays are [ticks]."""
    still = np.flatnonzero(influence == 0)
    first = int(still[0]) + 1 if len(still) else None
    return Undriven(len(still), first, (float(commands.min()), float(commands.max())))
