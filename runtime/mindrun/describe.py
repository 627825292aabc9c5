"""What a bundle holds, for people and for programs."""

from collections.abc import Iterator
from typing import Any

from mindrun.bundle import Bundle
from mindrun.readings import physical
from mindrun.registry import names


def describe(bundle: Bundle) -> str:
    """What a bundle holds, as lines of text."""
    return "\n".join(_lines(contents(bundle)))


def contents(bundle: Bundle) -> dict[str, Any]:
    """What a bundle holds, as plain data."""
    graph = bundle.graph
    own = physical(graph)
    return {
        "master": graph.master,
        "tick": graph.tick,
        "sensors": [
            {**_named(s.name, s.kind), "readings": s.width, "computed": s.name not in own} for s in graph.sensors
        ],
        "memories": [{**_named(m.name, m.kind), "decay": m.kind.decay} for m in graph.memories],
        "actuators": [{**_named(a.name, a.kind), "neutral": a.kind.neutral} for a in graph.actuators],
        "skills": [
            {**_named(s.name, s.function), "inputs": len(s.inputs), "weights": len(bundle.weights.get(s.name, ()))}
            for s in graph.skills
        ],
        "procedures": sorted(bundle.procedures),
    }


def _named(name: str, kind: object) -> dict[str, Any]:
    return {"name": name, "kind": names()[type(kind)]}


def _lines(found: dict[str, Any]) -> Iterator[str]:
    yield f"master {found['master']}, {1 / found['tick']:g} ticks a second"
    for part in found["sensors"]:
        computed = ", computed by the mind itself" if part["computed"] else ""
        yield f"sensor {part['name']} is {part['kind']}: {_many(part['readings'], 'reading')}{computed}"
    for part in found["memories"]:
        yield f"memory {part['name']} is {part['kind']}: decay {part['decay']:g}"
    for part in found["actuators"]:
        yield f"actuator {part['name']} is {part['kind']}: neutral {part['neutral']:g}"
    for part in found["skills"]:
        weights = f", {_many(part['weights'], 'weight')}" if part["weights"] else ""
        yield f"skill {part['name']} is {part['kind']}: {_many(part['inputs'], 'input')}{weights}"


def _many(count: int, noun: str) -> str:
    return f"{count} {noun}" + ("" if count == 1 else "s")
