"""Compiles `robot.yaml` to a Wiring, checked against a mind; raises nothing for any text.

Every sensor and actuator that is written is checked, and one that the mind needs and that is missing is an error.
"""

from collections.abc import Callable, Iterator, Mapping, Set
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from mindrun.errors import nearest, reason
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Actuator, Graph, Sensor
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring, read_by

from mindlang.compiler.diagnostic import Diagnostic, Findings, a, errors, listed, near_file
from mindlang.compiler.source import Source, decode_source
from mindlang.robot.claims import check_claims, check_shared
from mindlang.robot.driver import Wired, wired
from mindlang.robot.read import Node, Scalar, Table, TableEntry, read, shortened
from mindlang.robot.sensor import sensor_wire
from mindlang.robot.values import is_empty, missing_key, table, text, unknown_key

MAX_WIRING_BYTES = 256 << 10
KEYS = {
    "robot": "paper, or another name",
    "sensors": "and below it each of them with its driver",
    "actuators": "and below it each of them with its driver",
}
P = TypeVar("P", Sensor, Actuator)
W = TypeVar("W", SensorWire, ActuatorWire)


@dataclass(frozen=True, slots=True)
class Checked:
    """A wiring with its diagnostics; `wiring` is None where they hold an error."""

    wiring: Wiring | None
    diagnostics: tuple[Diagnostic, ...]
    readable: bool = True


def load_wiring(path: Path, graph: Graph, unit_metres: float | None = None) -> Checked:
    """The wiring of a mind in the file at `path`; whatever is wrong is in the diagnostics.

    `unit_metres` is how long a unit of the mind's world is on the robot, where the mind says so.
    """
    try:
        if path.is_dir():
            raise ValueError("is a folder")
        data = read_regular(path, MAX_WIRING_BYTES + 1)
        if len(data) > MAX_WIRING_BYTES:
            raise ValueError(f"is larger than {MAX_WIRING_BYTES >> 10} kB")
        return check_wiring(Source(str(path), decode_source(data), path.resolve().parent), graph, unit_metres)
    except (OSError, RuntimeError) as error:  # a loop of links is a RuntimeError
        message, hint = f"{path} cannot be read: {reason(error)}.", near_file(path)
    except ValueError as error:
        message, hint = f"{path} {error}.", f"A robot.yaml is UTF-8 text of at most {MAX_WIRING_BYTES >> 10} kB."
    return Checked(None, (Diagnostic("unreadable", message, None, hint),), readable=False)


def check_wiring(source: Source, graph: Graph, unit_metres: float | None = None) -> Checked:
    """The wiring that a text says, checked against a mind with its master."""
    findings = Findings()
    node = read(source, findings)
    wiring = _wiring(node, graph, unit_metres, findings) if node else None
    found = sorted(findings.diagnostics, key=lambda diagnostic: diagnostic.span.start if diagnostic.span else -1)
    return Checked(None if errors(found) else wiring, tuple(found))


def _wiring(node: Node, graph: Graph, unit_metres: float | None, findings: Findings) -> Wiring | None:
    top = table(node, "The file", "robot, sensors and actuators", findings)
    if top is None:
        return None
    said = top.entries
    strange = [entry.key for word, entry in said.items() if word not in KEYS]
    for key in strange:
        unknown_key(key, "The file", KEYS, findings)
    meant = {nearest(key.text, KEYS) for key in strange}
    for word, example in KEYS.items():
        if word not in said and word not in meant and top.whole:
            missing_key(top.span, "The file", word, example, findings)
    own, needed = physical(graph), read_by(graph, graph.master)
    moved = {actuator.name: actuator for actuator in graph.actuators}  # all of them, since each has a neutral
    wire_of = partial(sensor_wire, unit_metres=unit_metres, findings=findings)
    sensing = list(_section("sensor", said.get("sensors"), own, needed, graph, wire_of, findings))
    acting_wire_of = partial(actuator_wire, findings=findings)
    acting = list(_section("actuator", said.get("actuators"), moved, moved.keys(), graph, acting_wire_of, findings))
    check_claims([wired for wired, _ in (*sensing, *acting)], findings)
    check_shared(sensing, acting, graph.tick, findings)
    entry = said.get("robot")
    name = text(entry.value, findings) if entry and not is_empty(entry, findings) else None
    if entry and name and name.strip() != name:
        findings.error("not-a-text", entry.value.span, "A name has no spaces around it.", "Remove them.")
    wires = tuple(wire for _, wire in sensing if wire)
    return Wiring(name, wires, tuple(wire for _, wire in acting if wire)) if name else None


def _section(
    noun: str,
    entry: TableEntry | None,
    known: Mapping[str, P],
    needed: Set[str],
    graph: Graph,
    wire: Callable[[Wired, P], W | None],
    findings: Findings,
) -> Iterator[tuple[Wired, W | None]]:
    """The drivers of sensors or actuators in the order of the mind, each with its wire, None where that is wrong."""
    if entry is None:
        return
    value = entry.value
    if isinstance(value, Scalar) and value.plain and not value.text:
        value = Table({}, value.span)  # there may be none
    example = f"the name of {a(noun)} and a colon, and below it its driver"
    if (node := table(value, entry.key.text, example, findings)) is None:
        return
    strange = node.entries.keys() - known.keys()
    for name in strange:
        _refuse_stranger(noun, node.entries[name].key, known, graph, findings)
    meant = {nearest(name, known) for name in strange}
    missing = [name for name in known if name in needed - node.entries.keys() - meant]
    if node.whole and missing:
        does, many = {"sensor": "reads", "actuator": "drives"}[noun], "are" if len(missing) > 1 else "is"
        message = f"The mind {does} {listed(missing, 'and')}, which {many} not wired."
        hint = f"Add a line {missing[0]}: below {entry.key.text}, with its driver."
        findings.error(f"unwired-{noun}", entry.key.span, message, hint)
    example = "driver: and its name, and below it its options"
    for name in (name for name in known if name in node.entries):
        each = node.entries[name]
        inner = None if is_empty(each, findings) else table(each.value, shortened(name), example, findings)
        if inner and (found := wired(noun, each.key, inner, findings)):
            yield found, wire(found, known[name])


def _refuse_stranger(noun: str, key: Scalar, known: Mapping[str, Any], graph: Graph, findings: Findings) -> None:
    """Report a name that cannot be wired here: the mind does not have it, computes it, or has it as something else."""
    name = key.text
    own = physical(graph).keys()
    computed = {sensor.name for sensor in graph.sensors} - own | {cell.name for cell in graph.memories}
    if name in computed:
        hint = "Remove it: only what is measured or moved is wired."
        findings.error("computed-sensor", key.span, f"The mind computes {name} itself.", hint)
    elif name in own or name in {actuator.name for actuator in graph.actuators}:
        other = "sensors" if noun == "actuator" else "actuators"
        findings.error("wrong-section", key.span, f"{name} is no {noun} of the mind.", f"Move it below {other}.")
    else:
        add = f"Remove it, or add a line {noun} {shortened(name)} is … to the mind."
        hint = findings.suggest(name, known) or add
        findings.error(f"unknown-{noun}", key.span, f"The mind has no {noun} called {shortened(name)}.", hint)


def actuator_wire(wired: Wired, actuator: Actuator, findings: Findings) -> ActuatorWire | None:
    """The wire of an actuator, or None after reporting why it cannot be wired so."""
    own = {**wired.own}
    low, high = own.pop("limits", (0.0, 1.0))
    neutral = actuator.kind.neutral
    if low >= high:
        hint = "Write the smaller share first, [0.2, 0.8]; reversed: true turns the actuator round."
        findings.error("no-travel", wired.span("limits"), "Between these limits nothing can move.", hint)
        return None
    rest = neutral + own.get("trim", 0.0)
    if not low <= rest <= high:
        trimmed = " with its trim" * (rest != neutral)
        message = f"The neutral of {actuator.name}{trimmed}, {rest:g}, is outside of its limits."
        hint = f"It is what the mind says is safe: write limits that have {rest:g} between them."
        findings.error("neutral-outside", wired.span("limits"), message, hint)
        return None
    return ActuatorWire(actuator.name, wired.driver, low=float(low), high=float(high), **own)
