"""The engine for many rows of readings at once, bit for bit: what a mind sends for readings that are tried.

Readings for which nothing influences an actuator are looked for by trying, so that one that is found is a proof.
"""

from dataclasses import dataclass

import numpy as np
from mindrun.graph.graph import Graph, Program, Skill
from mindrun.graph.weights import Weights, genes, reachable
from mindrun.numbers.arrays import Singles, WeightsBySkill, columns, evaluate_rows
from mindrun.numbers.network import FLOAT32, NOTHING, matrices
from networkx import DiGraph

from mindlang.compiler.hierarchy import with_ancestors

TRIED_READINGS, MAX_WEIGHT_READINGS = 4096, 20_000_000  # readings, and weights times readings


@dataclass(frozen=True, slots=True)
class ThoughtRows:
    """Influence [rows, skills], Σ influence [rows, actuators] of each actuator and its command where that is not 0."""

    influence: Singles
    total: Singles
    command: Singles


def think_rows(graph: Graph, weights: WeightsBySkill, readings: Singles) -> ThoughtRows:
    """Equations 2 and 3 for readings [rows, graph.width], as `mindrun.engine.think` has them; no procedures."""
    places = graph.skill_numbers
    influence = np.zeros((len(readings), len(graph.skills)), np.float32)
    influence[:, places[graph.master]] = 1
    sums, totals = np.zeros((2, len(readings), len(graph.actuators)), np.float32)
    with np.errstate(all="ignore"):
        for skill in reachable(graph, graph.master):
            own = influence[:, places[skill.name]].copy()
            for edge, value in zip(skill.edges, sent_values(skill, weights.get(skill.owner), readings).T, strict=True):
                sound = np.isfinite(value)
                share = np.where(sound, np.clip(value, 0, 1), 0) * own
                if edge.to == "skill" and edge.cuts < np.inf:
                    influence[:, edge.target] += np.where(share < np.float32(edge.cuts), np.float32(0), share)
                elif edge.to == "actuator":
                    sums[:, edge.target] += share
                    totals[:, edge.target] += np.where(sound, own, 0)
        return ThoughtRows(influence, totals, np.clip(sums / totals, 0, 1))


def is_known(skill: Skill, weights: Weights | None) -> bool:
    """True if bounds of the skill's function can be computed: it is neither untaught nor Python code."""
    return skill.outputs == 0 or (not skill.function.opaque and (weights is not None or genes(skill) == 0))


def known_matrices(skill: Skill, weights: Weights | None) -> tuple[Singles, ...]:
    """The matrices of its layers; none where it has nothing to learn, or was not taught."""
    return () if weights is None else matrices(weights, skill.function.layers(len(skill.inputs), skill.outputs))


def sent_values(skill: Skill, weights: Weights | None, readings: Singles) -> Singles:
    """The values that a skill sends [rows, edges] before the clamp; NaN where a gate is closed and nothing is sent."""
    outputs, layers = np.zeros((len(readings), skill.outputs), np.float32), known_matrices(skill, weights)
    found = np.empty((len(readings), len(skill.edges)), np.float32)
    with np.errstate(all="ignore"):
        if layers:
            outputs = skill.function.forward(FLOAT32, layers, readings[:, list(skill.inputs)], NOTHING)[0]
        for number, edge in enumerate(skill.edges):
            found[:, number] = _evaluate(edge.value, readings) if edge.output is None else outputs[:, edge.output]
            if gate := edge.gate:
                holds = _evaluate(gate.when, readings)
                otherwise = np.float32(np.nan) if gate.otherwise is None else _evaluate(gate.otherwise, readings)
                closed = np.where(holds == 0, otherwise, np.float32(np.nan))
                found[:, number] = np.where(holds > 0, found[:, number], closed)
    if skill.chooses:
        influences = [number for number, edge in enumerate(skill.edges) if edge.to == "skill"]
        can_be = np.isfinite(found[:, influences])
        best = np.where(can_be, found[:, influences], -np.inf).argmax(axis=1)
        chosen = best[:, None] == np.arange(len(influences))
        found[:, influences] = np.where(can_be, chosen, np.float32(np.nan))
    return found


def _evaluate(program: Program, readings: Singles) -> Singles:
    return evaluate_rows(program, columns(readings), len(readings)).astype(np.float32)


@dataclass(frozen=True, slots=True)
class Tried:
    """The trial of an actuator: the range of its commands, and readings without influence on it.

    `still` are the skills that then have influence and pass none on towards the actuator.
    """

    commands: tuple[float, float] | None = None
    readings: Singles | None = None
    still: tuple[str, ...] = ()


def try_readings(graph: Graph, weights: WeightsBySkill) -> list[Tried]:
    """The trial of each actuator, empty where the function of a skill below the master is not known."""
    skills = reachable(graph, graph.master)
    if not all(is_known(skill, weights.get(skill.owner)) for skill in skills):
        return [Tried()] * len(graph.actuators)
    rows = max(64, min(TRIED_READINGS, MAX_WEIGHT_READINGS // sum(genes(skill) + 100 for skill in skills)))
    readings = readings_to_try(graph.width, rows)
    thoughts = think_rows(graph, weights, readings)
    return [_of(graph, readings, thoughts, actuator) for actuator in range(len(graph.actuators))]


def _of(graph: Graph, readings: Singles, thoughts: ThoughtRows, actuator: int) -> Tried:
    driven = (thoughts.total[:, actuator] > 0) & np.isfinite(thoughts.command[:, actuator])
    sent = thoughts.command[driven, actuator]
    commands = (float(sent.min()), float(sent.max())) if len(sent) else None
    if driven.all():
        return Tried(commands)
    row = int(np.argmin(driven))  # the first: corners come first, and read best
    return Tried(commands, readings[row], _still(graph, thoughts.influence[row], actuator))


def _still(graph: Graph, influence: Singles, actuator: int) -> tuple[str, ...]:
    """The skills that have influence and could lead to the actuator, none of whose subskills does both."""
    sent = [(edge.to, edge.target, place) for place, skill in enumerate(graph.skills) for edge in skill.edges]
    flow = DiGraph((("skill", place), (to, target)) for to, target, place in sent)
    flow.add_node(("actuator", actuator))
    leading = with_ancestors(flow, [("actuator", actuator)])
    awake = {place for place in np.flatnonzero(influence > 0).tolist() if ("skill", place) in leading}
    onward = {place for to, target, place in sent if to == "skill" and target in awake}
    return tuple(graph.skills[place].name for place in sorted(awake - onward))


def readings_to_try(width: int, rows: int) -> Singles:
    """Readings [rows, width]: first corners of the box, then points inside, the same ones every time."""
    rng = np.random.default_rng(1)
    corners = rng.integers(0, 2, (rows // 2, width)).astype(np.float32)
    return np.concatenate([corners, rng.random((rows - rows // 2, width), np.float32)])
