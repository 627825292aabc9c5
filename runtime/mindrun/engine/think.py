"""Thinking: readings to commands, without state. Influence comes down (Eq. 2), commands are averaged by it (Eq. 3).

Everything is float32, in the order of the graph: parents first, each skill's edges in theirs.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Edge, Gate, Program
from mindrun.graph.policy import Policy
from mindrun.graph.weights import reachable, weights_of
from mindrun.numbers.arrays import Compute
from mindrun.numbers.expression import evaluate

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@dataclass(frozen=True, slots=True)
class ReadyEdge:
    """An edge, ready to be computed. `to` is a skill's index or, with `drives`, a place in the commands."""

    drives: bool
    to: int
    output: int | None
    value: Program
    gate: Gate | None
    cuts: np.float32


@dataclass(frozen=True, slots=True)
class ReadySkill:
    """A skill, ready to be computed: what it reads, computes and sends."""

    index: int
    inputs: NDArray[np.intp]
    compute: Compute
    edges: tuple[ReadyEdge, ...]


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The skills that a master reaches, made ready. Commands go over the actuators, then the memories.

    `calm` [skills] is the influence before any is sent: 0, and NaN of skills that are not reached.
    """

    skills: tuple[ReadySkill, ...]
    calm: NDArray[np.float32]
    master: int
    commands: int


@dataclass(frozen=True, slots=True)
class Thought:
    """The result of thinking: influence [skills], command [commands] where `driven`, how many outputs were not sent."""

    influence: NDArray[np.float32]
    command: NDArray[np.float32]
    driven: NDArray[np.bool_]
    faults: int


def hierarchy(policy: Policy, sources: Mapping[str, str], master: str) -> Hierarchy:
    """Make every skill ready that `master` reaches; WeightsError or ProcedureError where one cannot be."""
    graph = policy.graph
    numbers = graph.skill_numbers
    calm = np.full(len(numbers), np.nan, np.float32)
    calm[[numbers[skill.name] for skill in reachable(graph, master)]] = _ZERO
    return Hierarchy(
        tuple(
            ReadySkill(
                numbers[skill.name],
                np.array(skill.inputs, np.intp),
                skill.function.ready(len(skill.inputs), skill.outputs, weights_of(skill, policy.weights), sources),
                tuple(_sent(edge, len(graph.actuators)) for edge in skill.edges),
            )
            for skill in reachable(graph, master)
        ),
        calm,
        numbers[master],
        len(graph.actuators) + len(graph.memories),
    )


def _sent(edge: Edge, actuators: int) -> ReadyEdge:
    place = edge.target + (actuators if edge.to == "memory" else 0)
    return ReadyEdge(edge.to != "skill", place, edge.output, edge.value, edge.gate, np.float32(edge.cuts))


def think(
    mind: Hierarchy, readings: NDArray[np.float32], replaced: Mapping[int, float] = MappingProxyType({})
) -> Thought:
    """Equations 2 and 3 over the full vector of readings; call it where numpy's warnings are off.

    Influence that is `replaced`, by the index of its skill, is this, whatever all above it send.
    """
    influence = mind.calm.copy()
    influence[mind.master] = _ONE
    commands, influences = np.zeros((2, mind.commands), np.float32)
    faults = 0
    for skill in mind.skills:
        if skill.index in replaced:
            influence[skill.index] = replaced[skill.index]
        own = influence[skill.index]
        if own == 0:
            continue
        for edge, value in zip(skill.edges, values(skill, readings), strict=True):
            if value is None:
                continue
            if not isfinite(value):
                faults += 1
                continue
            value = clamped(value) * own
            if edge.drives:
                commands[edge.to] += value
                influences[edge.to] += own
            elif not value < edge.cuts:
                influence[edge.to] += value
    return _mean(influence, commands, influences, faults)


def values(skill: ReadySkill, readings: NDArray[np.float32]) -> list[np.float32 | None]:
    """The values [edges] that a skill sends, before the clamp; all NaN where one of its inputs is not finite.

    None where a gate is closed and nothing is sent.
    """
    inputs = readings[skill.inputs]
    if not np.isfinite(inputs).all():
        return [np.float32(np.nan)] * len(skill.edges)
    outputs = skill.compute(inputs)
    return [
        gated(edge, edge.gate, outputs, readings) if edge.gate else value_of(edge, outputs, readings)
        for edge in skill.edges
    ]


def value_of(edge: ReadyEdge, outputs: NDArray[np.float32], readings: NDArray[np.float32]) -> np.float32:
    """The value of an edge, whatever its gate says."""
    return np.float32(evaluate(edge.value, readings)) if edge.output is None else outputs[edge.output]


def gated(
    edge: ReadyEdge, gate: Gate, outputs: NDArray[np.float32], readings: NDArray[np.float32]
) -> np.float32 | None:
    """The value of an edge with a gate, None where nothing is sent; NaN where the condition is not a number itself."""
    holds = evaluate(gate.when, readings)
    if holds > 0:
        return value_of(edge, outputs, readings)
    if holds == 0:
        return None if gate.otherwise is None else np.float32(evaluate(gate.otherwise, readings))
    return np.float32(np.nan)


def clamped(value: np.float32) -> np.float32:
    """The value within 0 to 1."""
    value = value if value > _ZERO else _ZERO
    return value if value < _ONE else _ONE


def _mean(
    influence: NDArray[np.float32], commands: NDArray[np.float32], influences: NDArray[np.float32], faults: int
) -> Thought:
    """Eq. 3. A mean that overflowed is a fault and drives nothing."""
    mean = commands / influences
    finite = np.isfinite(mean)
    driven = (influences > _ZERO) & finite
    faults += int(np.count_nonzero((influences != _ZERO) & ~finite))
    command = np.where(mean > _ZERO, mean, _ZERO)
    return Thought(influence, np.where(command < _ONE, command, _ONE), driven, faults)
