"""A table about a sensor → SensorWire: what its values mean, checked against the sensor of the mind."""

from math import isclose, tau

from mindrun.graph.graph import Sensor
from mindrun.graph.wiring import SensorWire
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import PIN

from mindlang.compiler.diagnostic import Findings, Label, errors
from mindlang.robot.direction import check_direction
from mindlang.robot.driver import Wired
from mindlang.robot.nodes import report_error
from mindlang.robot.scale import usual_ends
from mindlang.robot.speed import check_speed
from mindlang.robot.values import first_line, is_empty, number

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
    """The wire of a sensor, or None after reporting why it cannot be wired so.

    `unit_metres` is how long a unit of the mind's world is, where the mind says so.
    """
    before = len(errors(findings.diagnostics))
    usual = usual_ends(wired, sensor.kind, unit_metres)
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
        report_error(findings, "not-odd", wired.span("median"), f"{wire.median} is an even number.", hint)
    _check_times(wired, wire, findings)
    if len(errors(findings.diagnostics)) > before:
        return None
    check_direction(wired, wire, sensor, findings)
    check_speed(wired, wire, findings)
    return wire


def _end(wired: Wired, index: int, usual: tuple[float, float], findings: Findings) -> float | None:
    """The value that is the reading 0, or 1."""
    unit = wired.driver.unit
    entry = wired.entry(("from", "to")[index])
    if entry is None:
        return usual[index]
    if is_empty(entry, findings):
        return None
    name = f"a value in {unit}" if unit else "a number without a unit"
    found = number(entry.value, Quantity(name, UNITS.get(unit, {unit: 1.0}), low=-1e6, high=1e6), findings)
    return None if found is None else float(found)


def _check_readings(wired: Wired, sensor: Sensor, findings: Findings) -> None:
    """One value for each reading, and where there are pins, as many in each list."""
    count, name = wired.driver.readings, wired.name.text
    lists = [option.key for option in wired.options if option.shape == "numbers"]
    if count != sensor.width:
        message = f"The mind's {name} has {_count_readings(sensor.width)}, and this driver {count}."
        hint = (
            f"List {sensor.width} in {lists[0]}: one for each."
            if lists
            else "Take another driver, or wire another sensor to it."
        )
        report_error(findings, "wrong-width", wired.span(*lists, "driver"), message, hint)
        return
    for option in wired.options:
        entry, pins = wired.entry(option.key), wired.values[option.field]
        if option.type == PIN and entry and isinstance(pins, tuple) and len(pins) != count:
            message = f"{option.key} has {len(pins)} pin{'s' * (len(pins) != 1)}, for {_count_readings(count)}."
            hint = f"List {count}, in the order of the readings."
            report_error(findings, "wrong-count", first_line(entry.value.span), message, hint)


def _check_range(wired: Wired, wire: SensorWire, sensor: Sensor, findings: Findings) -> None:
    if wire.low == wire.high:
        labels = [Label(wired.span("from"), "the reading 0")] if wired.entry("from") and wired.entry("to") else []
        hint = "from is the value at which it reads 0, to the one at which it reads 1: write two different ones."
        report_error(
            findings,
            "no-range",
            wired.span("to", "from"),
            f"It would read 0 and 1 at the same value, {wire.low:g}.",
            hint,
            *labels,
        )
    elif sensor.kind.circular and not _is_turn(wire.high - wire.low, unit := wired.driver.unit):
        message = f"A bearing's readings 0 to 1 are a whole turn, and these are {abs(wire.high - wire.low):g} {unit}."
        usual = wired.driver.usual
        hint = f"Leave both out, or write from: {usual[0]:g} {unit} and to: {usual[1]:g} {unit}."
        report_error(findings, "not-a-turn", wired.span("to", "from", "driver"), message, hint)


def _is_turn(angle: float, unit: str) -> bool:
    """Whether an angle is once round, as far as decimals say it; of other units nobody knows."""
    turn = FULL_TURNS.get(unit)
    return turn is None or isclose(abs(angle), turn, rel_tol=TURN_TOLERANCE)


def _check_times(wired: Wired, wire: SensorWire, findings: Findings) -> None:
    apart = 1 / wire.rate
    if wire.max_age < apart:
        message = f"Measured every {apart:g} s, it would always be too old after {wire.max_age:g} s."
        hint = f"Write max_age: {2 * apart:.3g} s, twice the time between two of them, or a higher rate."
        labels = (
            [Label(wired.span("rate"), f"every {apart:g} s")] if wired.entry("rate") and wired.entry("max_age") else []
        )
        report_error(findings, "always-old", wired.span("max_age", "rate"), message, hint, *labels)
    if wired.entry("hold") and wire.on_fault != "hold":
        hint = "Add on_fault: hold, or remove it."
        report_error(findings, "idle-hold", wired.span("hold"), "Nothing is held here on a fault.", hint)


def _count_readings(count: int) -> str:
    return f"{count} reading{'s' * (count != 1)}"
