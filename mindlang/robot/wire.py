"""Compiles `robot.yaml` to a Wiring, checked against a mind; raises nothing for any text.

Every sensor and actuator that is written is checked, and one that the mind needs and that is missing is an error.
"""

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass, replace
from math import isclose, tau
from pathlib import Path
from typing import Any, TypeVar

from mindrun.errors import nearest, reason
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Actuator, Graph, Sensor
from mindrun.graph.named_readings import physical
from mindrun.graph.skill_sets import reachable
from mindrun.graph.wiring import ON_BROKEN, ActuatorWire, SensorWire, Wiring, read_by
from mindrun.kinds.registry import names
from mindrun.numbers.quantity import Quantity, fits
from mindrun.robot.driver_support import METRES, PIN

from mindlang.compiler.diagnostic import Diagnostic, Findings, Label, a, errors, listed, near_file
from mindlang.compiler.source import Source, decode_source
from mindlang.robot.claims import check_claims, check_shared, check_speed, warn
from mindlang.robot.driver import Wired, wired
from mindlang.robot.driver_inspection import near_value, timing_of
from mindlang.robot.options import driver_options
from mindlang.robot.read import Node, Scalar, Table, TableEntry, first_line, read, shortened
from mindlang.robot.values import check_keys, is_empty, number, table, text, word

MAX_WIRING_BYTES = 256 << 10
KEYS = {
    "robot": "paper, or another name",
    "sensors": "and below it each of them with its driver",
    "actuators": "and below it each of them with its driver",
}
ENDS = ("from", "to")
RANGE = "range"  # an option of drivers
# What a driver may measure in, and how people may write it.
UNITS = {
    "": {"": 1.0, "%": 0.01},
    "m": {"m": 1.0, "cm": 0.01, "mm": 0.001},
    "V": {"V": 1.0, "mV": 0.001},
    "m/s²": {"m/s²": 1.0, "m/s2": 1.0},
}
FULL_TURNS = {"deg": 360.0, "°": 360.0, "rad": tau}  # once round, by the unit of a driver
TURN_TOLERANCE = 1e-6
P = TypeVar("P", Sensor, Actuator)


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
    check_keys(top, top.span, "The file", (*KEYS, "on_broken"), KEYS, findings)
    own = physical(graph)
    needed = {name for name in read_by(graph, graph.master) if own[name].kind.needs_driver}
    moved = {actuator.name: actuator for actuator in graph.actuators}  # all of them, since each has a neutral
    measured = _section("sensor", said.get("sensors"), own, needed, graph, findings)
    sensing = [(wired, sensor_wire(wired, sensor, unit_metres, findings)) for wired, sensor in measured]
    driven = _section("actuator", said.get("actuators"), moved, moved.keys(), graph, findings)
    acting = [(wired, actuator_wire(wired, actuator, findings)) for wired, actuator in driven]
    check_claims([wired for wired, _ in (*sensing, *acting)], findings)
    check_shared(sensing, acting, graph.tick, findings)
    entry = said.get("robot")
    name = text(entry.value, findings) if entry and not is_empty(entry, findings) else None
    if entry and name and name.strip() != name:
        findings.error("not-a-text", entry.value.span, "A name has no spaces around it.", "Remove them.")
    wires = tuple(wire for _, wire in sensing if wire)
    reaction: Any = _reaction(said.get("on_broken"), graph, findings)
    return Wiring(name, wires, tuple(wire for _, wire in acting if wire), reaction) if name else None


def _reaction(entry: TableEntry | None, graph: Graph, findings: Findings) -> str:
    """What happens where a skill breaks what it promises."""
    if entry is None or is_empty(entry, findings):
        return "tell"
    if not any(skill.promises for skill in reachable(graph, graph.master)):
        hint = "Remove this line, or say in the mind what a skill maintains: maintains battery > 5%."
        message = f"Neither {graph.master} nor a skill below it promises anything that could be broken."
        findings.error("nothing-promised", entry.key.span, message, hint)
    return word(entry.value, ON_BROKEN, findings) or "tell"


def _section(
    noun: str, entry: TableEntry | None, known: Mapping[str, P], needed: Set[str], graph: Graph, findings: Findings
) -> Iterator[tuple[Wired, P]]:
    """The drivers of sensors or actuators in the order of the mind, each with what it wires."""
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
            yield found, known[name]


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


def sensor_wire(wired: Wired, sensor: Sensor, unit_metres: float | None, findings: Findings) -> SensorWire | None:
    """The wire of a sensor, or None after reporting why not; `unit_metres` is the length of a unit of the mind."""
    wired = _seeing_as_far(wired, sensor, unit_metres)
    before = len(errors(findings.diagnostics))
    usual = (float(wired.driver.usual[0]), float(wired.driver.usual[1]))
    if unit_metres and sensor.kind.unit == wired.driver.unit != "" and not wired.entry(RANGE):
        usual = (sensor.kind.ends[0] * unit_metres, sensor.kind.ends[1] * unit_metres)  # as long as in the mind's world
    low, high = (_end(wired, index, usual, findings) for index in (0, 1))
    if low is None or high is None:
        return None
    kind = sensor.kind
    defaults = {"blank": kind.blank, "dead_zone": float(getattr(kind, "dead_zone", 0.0))}
    wire = SensorWire(sensor.name, wired.driver, low, high, rest=kind.rest, **{**defaults, **wired.own})
    _check_readings(wired, sensor, findings)
    _check_range(wired, wire, sensor, findings)
    if wire.median % 2 == 0:
        hint = f"Only of an odd number one stands in the middle: write {wire.median - 1} or {wire.median + 1}."
        findings.error("not-odd", wired.span("median"), f"{wire.median} is an even number.", hint)
    _check_times(wired, wire, findings)
    if len(errors(findings.diagnostics)) > before:
        return None
    _check_direction(wired, wire, sensor, findings)
    check_speed(wired, wire, findings)
    return wire


def _seeing_as_far(wired: Wired, sensor: Sensor, unit_metres: float | None) -> Wired:
    """The driver with the range of the mind's sensor, where it has none and the mind says how long a unit is."""
    option = next((each for each in driver_options(type(wired.driver)) if each.key == RANGE), None)
    metres = (unit_metres or 0.0) * sensor.kind.ends[1]
    is_length = sensor.kind.unit == wired.driver.unit != ""
    if not (metres and is_length) or option is None or option.type is not METRES or wired.entry(RANGE):
        return wired
    if not fits(METRES, metres):
        return wired
    driver: Any = replace(wired.driver, **{option.field: metres})
    return replace(wired, driver=driver, timing=timing_of(driver, wired.noun))


def _end(wired: Wired, index: int, usual: tuple[float, float], findings: Findings) -> float | None:
    """The value that is the reading 0 or, with `index` 1, the reading 1."""
    unit = wired.driver.unit
    entry = wired.entry(ENDS[index])
    if entry is None:
        return usual[index]
    if is_empty(entry, findings):
        return None
    name = f"a value in {unit}" if unit else "a number without a unit"
    found = number(entry.value, Quantity(name, UNITS.get(unit, {unit: 1.0}), low=-1e6, high=1e6), findings)
    return None if found is None else float(found)


def _check_readings(wired: Wired, sensor: Sensor, findings: Findings) -> None:
    """Report a driver that has not one value for each reading, or not as many pins in a list."""
    count = wired.driver.readings
    lists = [option.key for option in wired.options if option.shape == "numbers"]
    of_mind = f"{sensor.width} reading{'s' * (sensor.width != 1)}"
    if count != sensor.width:
        message = f"The mind's {wired.name.text} has {of_mind}, and this driver {count}."
        hint = "Take another driver, or wire another sensor to it."
        if lists:
            hint = f"List {sensor.width} in {lists[0]}: one for each."
        findings.error("wrong-width", wired.span(*lists, "driver"), message, hint)
        return
    for option in wired.options:
        entry, pins = wired.entry(option.key), wired.values[option.field]
        if option.type == PIN and entry and isinstance(pins, tuple) and len(pins) != count:
            message = f"{option.key} has {len(pins)} pin{'s' * (len(pins) != 1)}, for {of_mind}."
            hint = f"List {count}, in the order of the readings."
            findings.error("wrong-count", first_line(entry.value.span), message, hint)


def _check_range(wired: Wired, wire: SensorWire, sensor: Sensor, findings: Findings) -> None:
    if wire.low == wire.high:
        labels = [Label(wired.span("from"), "the reading 0")] if wired.entry("from") and wired.entry("to") else []
        message = f"It would read 0 and 1 at the same value, {wire.low:g}."
        hint = "from is the value at which it reads 0, to the one at which it reads 1: write two different ones."
        findings.error("no-range", wired.span("to", "from"), message, hint, *labels)
        return
    unit, angle = wired.driver.unit, abs(wire.high - wire.low)
    turn = FULL_TURNS.get(unit, angle)  # of other units nobody knows how long it is
    if sensor.kind.circular and not isclose(angle, turn, rel_tol=TURN_TOLERANCE):
        message = f"A bearing's readings 0 to 1 are a whole turn, and these are {angle:g} {unit}."
        usual = wired.driver.usual
        hint = f"Leave both out, or write from: {usual[0]:g} {unit} and to: {usual[1]:g} {unit}."
        findings.error("not-a-turn", wired.span("to", "from", "driver"), message, hint)


def _check_times(wired: Wired, wire: SensorWire, findings: Findings) -> None:
    apart = 1 / wire.rate
    if wire.max_age < apart:
        message = f"Measured every {apart:g} s, it would always be too old after {wire.max_age:g} s."
        hint = f"Write max_age: {2 * apart:.3g} s, twice the time between two of them, or a higher rate."
        both = wired.entry("rate") and wired.entry("max_age")
        labels = [Label(wired.span("rate"), f"every {apart:g} s")] if both else []
        findings.error("always-old", wired.span("max_age", "rate"), message, hint, *labels)
    if wired.entry("hold") and wire.on_fault != "hold":
        hint = "Add on_fault: hold, or remove it."
        findings.error("idle-hold", wired.span("hold"), "Nothing is held here on a fault.", hint)


def _check_direction(wired: Wired, wire: SensorWire, sensor: Sensor, findings: Findings) -> None:
    """Warn where a sensor would read as near what is far; it may be meant so, and then it is taken."""
    near, is_near = near_value(wired.driver), sensor.kind.near
    if near is None or is_near is None:
        return
    ends, unit = (wire.low, wire.high), wired.driver.unit
    if abs(ends[is_near] - near) < abs(ends[1 - is_near] - near):
        return
    said = [Label(wired.span(end), f"the reading {ENDS.index(end)}") for end in ENDS if wired.entry(end)]
    place = said[0].span if said else wired.span("driver")
    kind = a(names()[type(sensor.kind)])
    message = f"{kind[0].upper()}{kind[1:]} reads {is_near} for what is near, and this one for what is far."
    at_0, at_1 = (f"{value:g} {unit}".strip() for value in ends[::-1])
    meaning = "The farther, the more metres." if unit == "m" else f"Touched, it is {near:g}."
    warn(findings, "reads-backwards", place, message, f"{meaning} Write from: {at_0} and to: {at_1}.", *said[1:])
