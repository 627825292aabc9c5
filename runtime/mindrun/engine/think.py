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
from mindrun.graph.scopes import Scopes, influence_scopes
from mindrun.graph.weights import reachable, weights_of
from mindrun.kinds.procedure_text import Sources
from mindrun.numbers.arithmetic import clamp
from mindrun.numbers.arrays import Bools, Compute, Singles
from mindrun.numbers.expression import evaluate

_ZERO, _ONE = np.float32(0.0), np.float32(1.0)


@dataclass(frozen=True, slots=True)
class ReadyEdge:
    """An edge, ready to be computed. `to` is a skill's index or, with `drives`, a place in the commands.

    Influence counts in its `scopes`; a command is weighed by that of the one of its sink.
    """

    drives: bool
    to: int
    output: int | None
    value: Program
    gate: Gate | None
    cuts: np.float32
    scopes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class ReadySkill:
    """A skill, ready to be computed: what it reads, computes and sends."""

    index: int
    inputs: NDArray[np.intp]
    compute: Compute
    edges: tuple[ReadyEdge, ...]
    chooses: bool


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The skills that a master reaches, made ready. Commands go over the actuators, then the memories.

    `calm` [scopes, skills] is the influence before any is sent: 0, and NaN of skills that are not reached.
    """

    skills: tuple[ReadySkill, ...]
    calm: Singles
    master: int
    commands: int


@dataclass(frozen=True, slots=True)
class Thought:
    """The result of thinking: influence [skills], command [commands] where `driven`, how many outputs were not sent."""

    influence: Singles
    command: Singles
    driven: Bools
    faults: int


def hierarchy(policy: Policy, sources: Sources, master: str) -> Hierarchy:
    """Make every skill ready that `master` reaches; WeightsError or ProcedureError where one cannot be."""
    graph = policy.graph
    numbers, scopes = graph.skill_numbers, influence_scopes(graph)
    calm = np.full((len(scopes.without), len(numbers)), np.nan, np.float32)
    calm[:, [numbers[skill.name] for skill in reachable(graph, master)]] = _ZERO
    return Hierarchy(
        tuple(
            ReadySkill(
                numbers[skill.name],
                np.array(skill.inputs, np.intp),
                skill.function.ready(len(skill.inputs), skill.outputs, weights_of(skill, policy.weights), sources),
                tuple(_sent(edge, len(graph.actuators), scopes) for edge in skill.edges),
                skill.chooses,
            )
            for skill in reachable(graph, master)
        ),
        calm,
        numbers[master],
        len(graph.actuators) + len(graph.memories),
    )


def _sent(edge: Edge, actuators: int, scopes: Scopes) -> ReadyEdge:
    place, cuts = edge.target + (actuators if edge.to == "memory" else 0), np.float32(edge.cuts)
    counting = scopes.counting(edge) if edge.to == "skill" else (scopes.of[edge.to, edge.target],)
    return ReadyEdge(edge.to != "skill", place, edge.output, edge.value, edge.gate, cuts, counting)


def think(mind: Hierarchy, readings: Singles, replaced: Mapping[int, float] = MappingProxyType({})) -> Thought:
    """Equations 2 and 3 over the full vector of readings; call it where numpy's warnings are off.

    Influence that is `replaced`, by the index of its skill, is this, whatever all above it send.
    """
    influence = mind.calm.copy()
    influence[:, mind.master] = _ONE
    commands, influences = np.zeros((2, mind.commands), np.float32)
    faults = 0
    for skill in mind.skills:
        if skill.index in replaced:
            influence[:, skill.index] = in_scopes(influence[:, skill.index], replaced[skill.index])
        if influence[0, skill.index] == 0:
            continue
        for edge, value in zip(skill.edges, values(skill, readings), strict=True):
            if value is None:
                continue
            if not isfinite(value):
                faults += 1
                continue
            value = clamp(value)
            for scope in edge.scopes:
                own = influence[scope, skill.index]
                if edge.drives:
                    commands[edge.to] += value * own
                    influences[edge.to] += own
                elif not value * own < edge.cuts:
                    influence[scope, edge.to] += value * own
    return _mean(influence[0], commands, influences, faults)


def in_scopes(influence: Singles, value: float) -> Singles:
    """Influence [scopes] of a skill that is `value` in the first scope: in the same ratios, or all `value` after 0."""
    before, now = influence.astype(np.float64), np.float64(np.float32(value))
    found = np.full(len(before), now) if before[0] == 0 else before * now / before[0]  # exact where nothing changes
    return found.astype(np.float32)


def values(skill: ReadySkill, readings: Singles) -> list[np.float32 | None]:
    """The values [edges] that a skill sends, before the clamp; all NaN where one of its inputs is not finite.

    None where a gate is closed and nothing is sent. Of a skill that chooses, those of its influences are 0 and one 1.
    """
    inputs = readings[skill.inputs]
    if not np.isfinite(inputs).all():
        return [np.float32(np.nan)] * len(skill.edges)
    outputs = skill.compute(inputs)
    found = [_value(edge, outputs, readings) for edge in skill.edges]
    return _chosen(skill, found) if skill.chooses else found


def _chosen(skill: ReadySkill, found: list[np.float32 | None]) -> list[np.float32 | None]:
    """The values with 1 for the influence that is greatest, of equals the first, and 0 for the others that are sent."""
    can_be = {
        place: value
        for place, (edge, value) in enumerate(zip(skill.edges, found, strict=True))
        if not edge.drives and value is not None and isfinite(value)
    }
    best = max(can_be, key=can_be.__getitem__, default=None)
    return [(_ONE if place == best else _ZERO) if place in can_be else value for place, value in enumerate(found)]


def _value(edge: ReadyEdge, outputs: Singles, readings: Singles) -> np.float32 | None:
    """The value of an edge, None where its gate is closed and nothing is sent; NaN where the condition is no number."""
    if gate := edge.gate:
        holds = evaluate(gate.when, readings)
        if holds == 0:
            return None if gate.otherwise is None else np.float32(evaluate(gate.otherwise, readings))
        if not holds > 0:
            return np.float32(np.nan)
    return np.float32(evaluate(edge.value, readings)) if edge.output is None else outputs[edge.output]


def _mean(influence: Singles, commands: Singles, influences: Singles, faults: int) -> Thought:
    """Eq. 3. A mean that overflowed is a fault and drives nothing."""
    mean = commands / influences
    finite = np.isfinite(mean)
    driven = (influences > _ZERO) & finite
    faults += int(np.count_nonzero((influences != _ZERO) & ~finite))
    command = np.where(mean > _ZERO, mean, _ZERO)
    return Thought(influence, np.where(command < _ONE, command, _ONE), driven, faults)
