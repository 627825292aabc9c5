"""Readings for which nothing influences an actuator: looked for by trying, so that one that is found is a proof."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.weights import Weights, genes, reachable

from mindlang.proofs.batch import Thoughts, think
from mindlang.proofs.branch_and_bound import readings_to_try
from mindlang.proofs.interval import Singles, is_known

TRIED_READINGS, MAX_WEIGHT_READINGS = 4096, 20_000_000  # readings, and weights times readings


@dataclass(frozen=True, slots=True)
class Tried:
    """What was seen of an actuator: its commands, and readings without influence on it.

    `still` are the skills that then have influence and pass none on towards the actuator.
    """

    commands: tuple[float, float] | None
    readings: Singles | None
    still: tuple[str, ...]


def try_out(graph: Graph, weights: Mapping[str, Weights]) -> list[Tried] | None:
    """What each actuator is sent for the readings that are tried; None where a skill below the master is not known."""
    skills = reachable(graph, graph.master)
    if not all(is_known(skill, weights.get(skill.owner)) for skill in skills):
        return None
    rows = max(64, min(TRIED_READINGS, MAX_WEIGHT_READINGS // sum(genes(skill) + 100 for skill in skills)))
    readings = readings_to_try(graph.width, rows)
    thoughts = think(graph, weights, readings)
    return [_of(graph, readings, thoughts, actuator) for actuator in range(len(graph.actuators))]


def _of(graph: Graph, readings: Singles, thoughts: Thoughts, actuator: int) -> Tried:
    driven = (thoughts.total[:, actuator] > 0) & np.isfinite(thoughts.command[:, actuator])
    sent = thoughts.command[driven, actuator]
    commands = (float(sent.min()), float(sent.max())) if len(sent) else None
    if driven.all():
        return Tried(commands, None, ())
    row = int(np.argmin(driven))  # the first: corners come first, and read best
    return Tried(commands, readings[row], _still(graph, thoughts.influence[row], actuator))


def _still(graph: Graph, influence: Singles, actuator: int) -> tuple[str, ...]:
    """The skills that have influence and could lead to the actuator, none of whose subskills does both."""
    leading = [False] * len(graph.skills)
    for place in reversed(range(len(graph.skills))):
        leading[place] = any(
            edge.target == actuator if edge.to == "actuator" else edge.to == "skill" and leading[edge.target]
            for edge in graph.skills[place].edges
        )
    awake = [here and found > 0 for here, found in zip(leading, influence.tolist(), strict=True)]
    return tuple(
        skill.name
        for skill, here in zip(graph.skills, awake, strict=True)
        if here and not any(edge.to == "skill" and awake[edge.target] for edge in skill.edges)
    )
