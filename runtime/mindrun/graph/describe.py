"""The contents of a bundle, for people and for programs."""

from collections.abc import Iterator
from typing import Any

from mindrun.graph.bundle import Bundle, fingerprint
from mindrun.graph.codec import encode
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import Wiring, code_digests, reckoned
from mindrun.kinds.registry import arguments, names


def describe(bundle: Bundle) -> str:
    """The contents of a bundle, as lines of text."""
    return "\n".join(_lines(contents(bundle)))


def contents(bundle: Bundle) -> dict[str, Any]:
    """The contents of a bundle, as plain data."""
    graph, weights = bundle.graph, bundle.policy.weights
    own = physical(graph)
    return {
        "master": graph.master,
        "tick": graph.tick,
        "sensors": [
            {**_named(s.name, s.kind), "readings": s.width, "computed": s.name not in own} for s in graph.sensors
        ],
        "memories": [{**_named(m.name, m.kind), **_said(m.kind)} for m in graph.memories],
        "actuators": [{**_named(a.name, a.kind), "neutral": a.kind.neutral} for a in graph.actuators],
        "skills": [
            {
                **_named(s.name, s.function),
                "inputs": len(s.inputs),
                "weights": len(weights.get(s.owner, ())),
                **({"like": s.like} if s.like else {}),
                **({"chooses": "one"} if s.chooses else {}),
            }
            for s in graph.skills
        ],
        "procedures": sorted(name for name, content in bundle.procedures.items() if isinstance(content, str)),
        **({"files": files} if (files := sorted({name for s in graph.skills for name in s.files})) else {}),
        **({"robot": _robot(bundle.wiring, graph)} if bundle.wiring else {}),
    }


def _robot(wiring: Wiring, graph: Graph) -> dict[str, Any]:
    """The wiring as it stands in the bundle; of each sensor the unit of its values, too."""
    return {
        "name": wiring.robot,
        "wiring": fingerprint(wiring),
        **({"drivers": digests} if (digests := code_digests(wiring)) else {}),
        "sensors": [{**encode(wire), "unit": wire.driver.unit} for wire in wiring.sensors],
        **({"reckoned": found} if (found := reckoned(wiring, graph)) else {}),
        "actuators": [encode(wire) for wire in wiring.actuators],
    }


def _driver(wire: dict[str, Any]) -> str:
    return str(wire["driver"].get("name", wire["driver"]["is"]))


def _named(name: str, kind: object) -> dict[str, Any]:
    return {"name": name, "kind": names()[type(kind)]}


def _said(kind: Any) -> dict[str, Any]:
    """The arguments of a kind that differ from their defaults, by key."""
    said = ((each, getattr(kind, each.field)) for each in arguments(type(kind)))
    return {each.key: value for each, value in said if value != each.default}


def _lines(found: dict[str, Any]) -> Iterator[str]:
    yield f"master {found['master']}, {1 / found['tick']:g} ticks a second"
    for part in found["sensors"]:
        computed = ", computed by the mind itself" if part["computed"] else ""
        yield f"sensor {part['name']} is {part['kind']}: {_counted(part['readings'], 'reading')}{computed}"
    for part in found["memories"]:
        said = [f"{key} {value:g}" if isinstance(value, float) else f"{key} {value}" for key, value in part.items()]
        yield f"memory {part['name']} is {part['kind']}" + f": {', '.join(said[2:])}" * (len(said) > 2)
    for part in found["actuators"]:
        yield f"actuator {part['name']} is {part['kind']}: neutral {part['neutral']:g}"
    for part in found["skills"]:
        weights = f", {_counted(part['weights'], 'weight')}" if part["weights"] else ""
        shared = f", those of {part['like']}" if "like" in part else ""
        yield f"skill {part['name']} is {part['kind']}: {_counted(part['inputs'], 'input')}{weights}{shared}"
    yield from (f"file {name}" for name in found.get("files", ()))
    if "robot" in found:
        yield from _wires(found["robot"])


def _wires(robot: dict[str, Any]) -> Iterator[str]:
    yield f"robot {robot['name']}, wiring {robot['wiring'][:12]}"
    for name, digest in robot.get("drivers", {}).items():
        yield f"driver {name} is the user's own, {digest[:12]}"
    for wire in robot["sensors"]:
        median = f", the median of {wire['median']}" if wire["median"] > 1 else ""
        values = f"{wire['low']:g} to {wire['high']:g} {wire['unit']}".rstrip()
        yield (
            f"sensor {wire['sensor']} is wired to {_driver(wire)}: {values}, {wire['rate']:g} Hz{median}, "
            f"{wire['on_fault']} when older than {wire['max_age']:g} s"
        )
    for sensor, servo in robot.get("reckoned", {}).items():
        yield f"sensor {sensor} is reckoned from what {servo} is sent"
    for wire in robot["actuators"]:
        slew = f", at most {wire['slew']:g} a second" if wire["slew"] else ""
        turned = ", reversed" if wire["reversed"] else ""
        limits = f"{wire['low']:g} to {wire['high']:g}"
        yield f"actuator {wire['actuator']} is wired to {_driver(wire)}: {limits}{slew}{turned}"


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" + ("" if count == 1 else "s")
