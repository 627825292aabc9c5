"""The wiring of a robot: each sensor and actuator of a mind with its driver; how values become 0..1 and back.

It comes from `robot.yaml` and travels in the bundle, checked against the mind by the compiler.
"""

from collections.abc import Iterator, Set
from dataclasses import dataclass, replace
from math import isfinite, nan
from typing import Annotated, Literal, get_args

from mindrun.driver import ActuatorDriver, SensorDriver, driver_name
from mindrun.graph.graph import Graph
from mindrun.graph.measured import with_sources
from mindrun.graph.named_readings import physical
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.registry import left_out
from mindrun.numbers.quantity import Number, Quantity, Ratio, Reference

VALUES = Quantity("a number of values", {"": 1.0}, low=1, high=15, whole=True)
HERTZ = Quantity("a rate", {"Hz": 1.0}, low=0.01, high=1000)
TIME = Quantity("a time", {"s": 1.0, "ms": 0.001}, low=1e-9, high=3600)
TRIM = Quantity("a share of the travel", {"": 1.0, "%": 0.01}, low=-0.5, high=0.5)
A_SECOND = Quantity("how much of the travel in a second", {"/s": 1.0}, low=0.0)
SWITCH = Reference("switch", ("true", "false"))
OnFault = Literal["neutral", "hold", "blank"]
ON_FAULT = Reference("reaction", get_args(OnFault))
OnBroken = Literal["tell", "neutral"]
ON_BROKEN = Reference("reaction", get_args(OnBroken))


@dataclass(frozen=True, slots=True)
class SensorWire:
    """The wiring of a sensor: its driver, and how values become readings.

    Its reading is 0 at the value `low` and 1 at `high`, which may be the smaller one. Beyond them it stays that; a
    direction goes round. Closer to `rest` than `dead_zone` it is `rest`, as in training. `median` of so many values is
    taken, `rate` times a second. Where there is nothing to measure it reads `blank`. What was measured more
    than `max_age` ago, or failed, is a fault: then every actuator goes to neutral (`on_fault` "neutral"), the reading
    before is held for `hold` seconds more ("hold"), or it reads `blank`.
    """

    sensor: str
    driver: SensorDriver
    low: Number
    high: Number
    median: Annotated[int, VALUES] = 1
    rate: Annotated[float, HERTZ] = 20.0
    max_age: Annotated[float, TIME] = 0.25
    on_fault: Annotated[OnFault, ON_FAULT] = "neutral"
    hold: Annotated[float, TIME] = 0.5
    blank: Ratio = 1.0
    dead_zone: Ratio = 0.0
    rest: Ratio = 0.0


@dataclass(frozen=True, slots=True)
class ActuatorWire:
    """The wiring of an actuator: its driver, and how commands become its values.

    Neutral is the mind's and the `trim`, 0 and 1 stay what they are, and the way between is as even: of it the share
    `least` is gone as soon as a command is not neutral. What comes of that is kept within `low` and `high`, changed by
    no more than `slew` a second (0: at once), and turned round where it is `reversed`; neutral at once and within no
    limits.
    """

    actuator: str
    driver: ActuatorDriver
    trim: Annotated[float, TRIM] = 0.0
    low: Ratio = 0.0
    high: Ratio = 1.0
    slew: Annotated[float, A_SECOND] = 0.0
    reversed: Annotated[bool, SWITCH] = False
    least: Ratio = left_out(0.0)


@dataclass(frozen=True, slots=True)
class Wiring:
    """A robot: every actuator of one mind, and every physical sensor that its active skills read (or more of them).

    Both are in the order of its graph. Where a skill breaks what it promises, the loop tells of it (`on_broken`
    "tell"), or brings every actuator to neutral as well ("neutral").
    """

    robot: str
    sensors: tuple[SensorWire, ...]
    actuators: tuple[ActuatorWire, ...]
    on_broken: OnBroken = left_out("tell")


def reading(wire: SensorWire, raw: float | None, circular: bool | None = False) -> float:
    """The reading of a raw value: `blank` for None; NaN, which is a fault, for what is not finite."""
    if raw is None:
        return wire.blank
    share = (raw - wire.low) / (wire.high - wire.low) if isfinite(raw) else nan
    if not isfinite(share):  # asked before it is clamped: max(0, min(1, NaN)) is 1
        return nan
    share = within_turn(share) if circular else max(0.0, min(1.0, share))
    return wire.rest if abs(share - wire.rest) < wire.dead_zone else share


def within_turn(share: float) -> float:
    """A direction in turns within 0..1: 1.25 is 0.25. What is within stays as it is."""
    return (share if 0.0 <= share <= 1.0 else share % 1.0) + 0.0  # where it was −0.0, too


def code_digests(wiring: Wiring) -> dict[str, str]:
    """The drivers that users bring, by name, with the SHA-256 of their code."""
    drivers = [*(wire.driver for wire in wiring.sensors), *(wire.driver for wire in wiring.actuators)]
    return {driver_name(driver): driver.digest for driver in drivers if hasattr(driver, "digest")}


def still(wire: SensorWire) -> SensorWire:
    """The wiring of a sensor that moves nothing, such as a camera's neck."""
    return replace(wire, driver=getattr(wire.driver, "motionless", wire.driver))


def read_by(graph: Graph, master: str) -> Set[str]:
    """The physical sensors that `master`, or a skill that it can influence, reads, even as a derivative."""
    inputs = {index for skill in reachable(graph, master) for index in skill.inputs}
    return {sensor.name for sensor in with_sources(graph, inputs)} & physical(graph).keys()


def reckoned(wiring: Wiring, graph: Graph) -> dict[str, str]:
    """The sensors that read where a servo looks without a driver, so that it is reckoned; with the servo of each."""
    wired = {wire.sensor for wire in wiring.sensors}
    return {each.name: each.kind.servo for each in graph.sensors if each.kind.tells_servo and each.name not in wired}


def known_sensors(wiring: Wiring, graph: Graph) -> tuple[str, ...]:
    """The sensors that are wired or reckoned, in the order of the graph."""
    known = {*reckoned(wiring, graph), *(wire.sensor for wire in wiring.sensors)}
    return tuple(sensor.name for sensor in graph.sensors if sensor.name in known)


def flaws(wiring: Wiring, graph: Graph) -> Iterator[str]:
    """Why a robot that is wired so cannot have this mind."""
    sensors, actuators = physical(graph), {actuator.name: actuator.kind for actuator in graph.actuators}
    wired = [wire.sensor for wire in wiring.sensors]
    known = set(wired)
    if not wiring.robot or not wiring.robot.isprintable():
        yield "its robot has no name that can be printed"
    needed = {name for name in read_by(graph, graph.master) if sensors[name].kind.needs_driver}
    if wired != [name for name in sensors if name in known] or not needed <= known:
        yield "its sensors are not those of the mind"
    if [wire.actuator for wire in wiring.actuators] != list(actuators):
        yield "its actuators are not those of the mind"
    for wire in wiring.sensors:
        if wire.low == wire.high:
            yield f"sensor {wire.sensor} has no range"
        if wire.sensor in sensors and wire.driver.readings != sensors[wire.sensor].width:
            yield f"sensor {wire.sensor} has {sensors[wire.sensor].width} readings, its driver {wire.driver.readings}"
    for end in wiring.actuators:
        if end.actuator in actuators and not end.low <= actuators[end.actuator].neutral + end.trim <= end.high:
            yield f"neutral of actuator {end.actuator} is outside of its limits"
