"""Whether a sensor reads forwards: what is near on the robot must be what was near in training."""

from mindrun.graph.graph import Sensor
from mindrun.graph.wiring import SensorWire
from mindrun.kinds.registry import names

from mindlang.compiler.diagnostic import Findings, Label, a
from mindlang.robot.driver import Wired
from mindlang.robot.nodes import report_warning

ENDS = ("from", "to")
METRES = "m"


def check_direction(wired: Wired, wire: SensorWire, sensor: Sensor, findings: Findings) -> None:
    """Warn where a sensor would read as near what is far; it may be meant so, and then it is taken."""
    near, is_near = near_value(wired.driver), sensor.kind.near
    if near is None or is_near is None:
        return
    ends = wire.low, wire.high
    if abs(ends[is_near] - near) < abs(ends[1 - is_near] - near):
        return
    said = [Label(wired.span(end), f"the reading {ENDS.index(end)}") for end in ENDS if wired.entry(end)]
    first, *others = [*said, Label(wired.span("driver"), "")][: max(1, len(said))]
    kind = a(names()[type(sensor.kind)])
    message = f"{kind[0].upper()}{kind[1:]} reads {is_near} for what is near, and this one for what is far."
    at_0, at_1 = (f"{value:g} {wired.driver.unit}".strip() for value in ends[::-1])
    hint = f"{_meaning(wired, near)} Write from: {at_0} and to: {at_1}."
    report_warning(findings, "reads-backwards", first.span, message, hint, *others)


def near_value(driver: object) -> float | None:
    """The value of a driver that means that something is near; None where that depends on what is connected."""
    near: float | None = getattr(driver, "near", 0.0 if getattr(driver, "unit", "") == METRES else None)
    return near


def _meaning(wired: Wired, near: float) -> str:
    return "The farther, the more metres." if wired.driver.unit == METRES else f"Touched, it is {near:g}."
