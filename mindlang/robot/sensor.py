"""A table about a sensor → SensorWire: what its values mean, checked against the sensor of the mind."""

from dataclasses import replace
from math import isclose, tau
from typing import Any

from mindrun.graph.graph import Sensor
from mindrun.graph.wiring import SensorWire
from mindrun.kinds.registry import names
from mindrun.numbers.quantity import Quantity, fits
from mindrun.robot.driver_support import METRES, PIN

from mindlang.compiler.diagnostic import Findings, Label, a, errors
from mindlang.robot.claims import check_speed, warn
from mindlang.robot.driver import Wired
from mindlang.robot.driver_inspection import near_value, timing_of
from mindlang.robot.options import driver_options
from mindlang.robot.read import first_line
from mindlang.robot.values import is_empty, number

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
    count, name = wired.driver.readings, wired.name.text
    lists = [option.key for option in wired.options if option.shape == "numbers"]
    if count != sensor.width:
        message = f"The mind's {name} has {_count_readings(sensor.width)}, and this driver {count}."
        hint = "Take another driver, or wire another sensor to it."
        if lists:
            hint = f"List {sensor.width} in {lists[0]}: one for each."
        findings.error("wrong-width", wired.span(*lists, "driver"), message, hint)
        return
    for option in wired.options:
        entry, pins = wired.entry(option.key), wired.values[option.field]
        if option.type == PIN and entry and isinstance(pins, tuple) and len(pins) != count:
            message = f"{option.key} has {len(pins)} pin{'s' * (len(pins) != 1)}, for {_count_readings(count)}."
            hint = f"List {count}, in the order of the readings."
            findings.error("wrong-count", first_line(entry.value.span), message, hint)


def _count_readings(count: int) -> str:
    return f"{count} reading{'s' * (count != 1)}"


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
