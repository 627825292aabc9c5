"""All sensors, or all actuators: each that is written, and each that is not but has to be."""

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from typing import Any, TypeVar

from mindrun.errors import nearest
from mindrun.graph.graph import Actuator, Graph, Sensor
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import ActuatorWire, SensorWire, read_by

from mindlang.compiler.diagnostic import Findings, a, listed
from mindlang.robot.driver import Wired, wired
from mindlang.robot.nodes import Scalar, Table, TableEntry, report_error, shortened
from mindlang.robot.scale import seeing_as_far
from mindlang.robot.sensor import sensor_wire
from mindlang.robot.values import is_empty, table

P = TypeVar("P", Sensor, Actuator)
W = TypeVar("W", SensorWire, ActuatorWire)


def sensors(
    entry: TableEntry | None, graph: Graph, unit_metres: float | None, findings: Findings
) -> list[tuple[Wired, SensorWire | None]]:
    """What is wired to sensors, in the order of the mind; without a wire where one is wrong."""
    needed = read_by(graph, graph.master)

    def wire(wired: Wired, sensor: Sensor, findings: Findings) -> SensorWire | None:
        return sensor_wire(seeing_as_far(wired, sensor, unit_metres), sensor, unit_metres, findings)

    return list(_section("sensor", entry, physical(graph), needed, graph, wire, findings))


def actuators(entry: TableEntry | None, graph: Graph, findings: Findings) -> list[tuple[Wired, ActuatorWire | None]]:
    """What is wired to actuators, in the order of the mind; all of them, since each has a neutral."""
    known = {actuator.name: actuator for actuator in graph.actuators}
    return list(_section("actuator", entry, known, known.keys(), graph, actuator_wire, findings))


def _section(
    noun: str,
    entry: TableEntry | None,
    known: Mapping[str, P],
    needed: Set[str],
    graph: Graph,
    wire: Callable[[Wired, P, Findings], W | None],
    findings: Findings,
) -> Iterator[tuple[Wired, W | None]]:
    node = _table(noun, entry, findings)
    if entry is None or node is None:
        return
    written = {each.key.text: each for each in node.entries}
    for name in written.keys() - known.keys():
        _stranger(noun, written[name].key, known, graph, findings)
    meant = {nearest(name, known) for name in written.keys() - known.keys()}
    missing = [name for name in known if name in needed - written.keys() - meant]
    if node.whole and missing:
        _unwired(noun, entry.key, missing, findings)
    for name in (name for name in known if name in written):
        inner = None if is_empty(written[name], findings) else _inner(written[name], findings)
        found = wired(noun, written[name].key, inner, findings) if inner else None
        if found:
            yield found, wire(found, known[name], findings)


def _table(noun: str, entry: TableEntry | None, findings: Findings) -> Table | None:
    """The entries of a section, which may be empty."""
    match entry:
        case None:
            return None
        case TableEntry(value=Scalar(text="", plain=True, span=span)):
            return Table((), span)
    return table(entry.value, entry.key.text, f"the name of {a(noun)} and a colon, and below it its driver", findings)


def _inner(entry: TableEntry, findings: Findings) -> Table | None:
    return table(entry.value, shortened(entry.key.text), "driver: and its name, and below it its options", findings)


def _unwired(noun: str, key: Scalar, missing: Sequence[str], findings: Findings) -> None:
    does = {"sensor": "reads", "actuator": "drives"}[noun]
    many = "are" if len(missing) > 1 else "is"
    message = f"The mind {does} {listed(missing, 'and')}, which {many} not wired."
    report_error(
        findings, f"unwired-{noun}", key.span, message, f"Add a line {missing[0]}: below {key.text}, with its driver."
    )


def _stranger(noun: str, key: Scalar, known: Mapping[str, Any], graph: Graph, findings: Findings) -> None:
    """A name that cannot be wired here: the mind does not have it, computes it, or has it as something else."""
    name = key.text
    own = physical(graph).keys()
    computed = {sensor.name for sensor in graph.sensors} - own | {cell.name for cell in graph.memories}
    if name in computed:
        hint = "Remove it: only what is measured or moved is wired."
        report_error(findings, "computed-sensor", key.span, f"The mind computes {name} itself.", hint)
    elif name in own or name in {actuator.name for actuator in graph.actuators}:
        other = "sensors" if noun == "actuator" else "actuators"
        report_error(
            findings, "wrong-section", key.span, f"{name} is no {noun} of the mind.", f"Move it below {other}."
        )
    else:
        add = f"Remove it, or add a line {noun} {shortened(name)} is … to the mind."
        hint = findings.suggest(name, known) or add
        report_error(findings, f"unknown-{noun}", key.span, f"The mind has no {noun} called {shortened(name)}.", hint)


def actuator_wire(wired: Wired, actuator: Actuator, findings: Findings) -> ActuatorWire | None:
    """The wire of an actuator, or None after reporting why it cannot be wired so."""
    own = {**wired.own}
    low, high = own.pop("limits", (0.0, 1.0))
    neutral = actuator.kind.neutral
    if low >= high:
        hint = "Write the smaller share first, [0.2, 0.8]; reversed: true turns the actuator round."
        report_error(findings, "no-travel", wired.span("limits"), "Between these limits nothing can move.", hint)
        return None
    rest = neutral + own.get("trim", 0.0)
    if not low <= rest <= high:
        trimmed = " with its trim" * (rest != neutral)
        message = f"The neutral of {actuator.name}{trimmed}, {rest:g}, is outside of its limits."
        hint = f"It is what the mind says is safe: write limits that have {rest:g} between them."
        report_error(findings, "neutral-outside", wired.span("limits"), message, hint)
        return None
    return ActuatorWire(actuator.name, wired.driver, low=float(low), high=float(high), **own)
