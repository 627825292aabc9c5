"""A proof as plain data: the contents of `--json`. Every claim has `rests_on`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from mindrun.graph.graph import Graph
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.proofs.leak import Leak
from mindlang.proofs.proof import DECLARATION, OfActuator, OfEdge, Proof
from mindlang.proofs.silence_search import Tried

if TYPE_CHECKING:
    from mindlang.proofs.recorded import Recorded

Hashes = Mapping[str, str]  # the SHA-256 of each skill's weights


def rests_on(skills: Iterable[str], hashes: Hashes) -> list[str]:
    """What a claim rests on, beside the declaration."""
    return [f"the weights {hashes[skill][:4]}… of {skill}" for skill in skills] or [DECLARATION]


def run_of(run: Recorded) -> str:
    """A run, in words."""
    return f"a run of {in_words(run.ticks)} of task {run.task}, seed {run.seed}"


def as_data(proof: Proof, hashes: Hashes, run: Recorded | None) -> dict[str, Any]:
    """A whole proof as plain data."""
    return {
        "master": proof.graph.master,
        "assumes": "every reading is a number from 0 to 1",
        "delta": proof.delta,
        "weights": dict(hashes),
        "unknown": dict(proof.unknown),
        "not_below_master": list(proof.outside),
        "actuators": [_actuator(found, place, proof, hashes, run) for place, found in enumerate(proof.actuators)],
        "edges": [_edge(edge, hashes) for edge in proof.edges],
        "dead_skills": [{"skill": name, "rests_on": rests_on(why, hashes)} for name, why in proof.dead.items()],
        "run": None if run is None else {"task": run.task, "seed": run.seed, "ticks": run.ticks, "faults": run.faults},
    }


def _actuator(found: OfActuator, place: int, proof: Proof, hashes: Hashes, run: Recorded | None) -> dict[str, Any]:
    tried, total = found.tried, found.driven.total
    low, high = found.command
    data: dict[str, Any] = {
        "actuator": found.actuator.name,
        "paths": {
            "count": found.paths.count,
            "first": [list(path) for path in found.paths.first],
            "rests_on": [DECLARATION],
        },
        "leak": found.leak and _leak(found.leak),
        "command": {
            "low": low,
            "high": high,
            "seen": tried and tried.commands,
            "needs_influence_of": 1e-30 if found.is_rough else 0.0,
            "rests_on": rests_on(found.weights, hashes),
        },
        "neutral": {
            "value": float(found.actuator.kind.neutral),
            "sent": found.neutral,
            "influence": [total.low, total.high if total.high < float("inf") else None],
            "example": _example(proof.graph, tried),
            "rests_on": rests_on(hashes if found.neutral == "can be" else found.weights, hashes),
        },
    }
    if run is not None:
        undriven = run.actuators[place]
        data["run"] = {
            "neutral_ticks": undriven.ticks,
            "first_tick": undriven.first,
            "commands": list(undriven.commands),
            "rests_on": [run_of(run)],
        }
    return data


def _leak(leak: Leak) -> dict[str, Any]:
    return {
        "share": leak.share,
        "worst": leak.worst and leak.worst.skill,
        "levels": [{"skill": level.skill, "share": level.share, "into": list(level.into)} for level in leak.levels],
        "rests_on": [DECLARATION],
    }


def _example(graph: Graph, tried: Tried | None) -> dict[str, Any] | None:
    """Readings for which nothing influences an actuator, and which skills keep still then."""
    if tried is None or tried.readings is None:
        return None
    values = tried.readings.tolist()
    readings = {sensor.name: values[sensor.start : sensor.start + sensor.width] for sensor in graph.sensors}
    return {"still": list(tried.still), "readings": readings | {m.name: [values[m.start]] for m in graph.memories}}


def _edge(edge: OfEdge, hashes: Hashes) -> dict[str, Any]:
    sends = edge.range
    return {
        "skill": edge.skill,
        "target": edge.target,
        "low": sends.low if sends.sure else 0.0,
        "high": sends.high,
        "seen": sends.seen,
        "rests_on": rests_on(edge.weights, hashes),
    }
