"""Thinking over many readings at once: the engine's operations in its order, row by row the same bits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from mindrun.graph.graph import Gate, Graph, Program, Skill
from mindrun.graph.weights import Weights, reachable
from mindrun.numbers.evaluation import OPERATORS
from mindrun.numbers.expression import fold
from mindrun.numbers.network import running

from mindlang.proofs.interval import Doubles, Singles, perceptron


@dataclass(frozen=True, slots=True)
class Thoughts:
    """Influence [rows, skills], Σ influence [rows, actuators] of each actuator and its command where that is not 0."""

    influence: Singles
    total: Singles
    command: Singles


def think(graph: Graph, weights: Mapping[str, Weights], readings: Singles) -> Thoughts:
    """Equations 2 and 3 for readings [rows, graph.width], as `mindrun.engine.think` has them; no procedures."""
    places = graph.skill_numbers
    influence = np.zeros((len(readings), len(graph.skills)), np.float32)
    influence[:, places[graph.master]] = 1
    sums, totals = np.zeros((2, len(readings), len(graph.actuators)), np.float32)
    with np.errstate(all="ignore"):
        for skill in reachable(graph, graph.master):
            own = influence[:, places[skill.name]].copy()
            for edge, value in zip(skill.edges, values(skill, weights.get(skill.owner), readings).T, strict=True):
                sound = np.isfinite(value)
                share = np.where(sound, np.clip(value, 0, 1), 0) * own
                if edge.to == "skill":
                    influence[:, edge.target] += np.where(share < np.float32(edge.cuts), np.float32(0), share)
                elif edge.to == "actuator":
                    sums[:, edge.target] += share
                    totals[:, edge.target] += np.where(sound, own, 0)
        return Thoughts(influence, totals, np.clip(sums / totals, 0, 1))


def values(skill: Skill, weights: Weights | None, readings: Singles) -> Singles:
    """What a skill sends [rows, edges] before the clamp; NaN where a gate is closed and nothing is sent."""
    outputs = _outputs(skill, weights, readings)
    found = np.empty((len(readings), len(skill.edges)), np.float32)
    with np.errstate(all="ignore"):
        for number, edge in enumerate(skill.edges):
            found[:, number] = _evaluate(edge.value, readings) if edge.output is None else outputs[:, edge.output]
            if edge.gate:
                found[:, number] = _gated(edge.gate, found[:, number], readings)
    return found


def _gated(gate: Gate, value: Singles, readings: Singles) -> Singles:
    holds = _evaluate(gate.when, readings)
    otherwise = np.float32(np.nan) if gate.otherwise is None else _evaluate(gate.otherwise, readings)
    found: Singles = np.where(holds > 0, value, np.where(holds == 0, otherwise, np.float32(np.nan)))
    return found


def _outputs(skill: Skill, weights: Weights | None, readings: Singles) -> Singles:
    layers = perceptron(skill, weights)
    if not layers:
        return np.zeros((len(readings), skill.outputs), np.float32)
    with np.errstate(all="ignore"):
        return running(skill.function.forward, layers, 0)(readings[:, list(skill.inputs)])


def _evaluate(program: Program, readings: Singles) -> Singles:
    def leaf(word: str, operand: float | int) -> Doubles:
        if word == "reading":
            return readings[:, int(operand)].astype(np.float64)
        return np.full(len(readings), operand, np.float64)

    def combined(operator: str, left: Doubles, right: Doubles) -> Doubles:
        found: Doubles = OPERATORS[operator](left, right)
        return found

    found: Singles = fold(program, leaf, np.negative, combined).astype(np.float32)
    return found
