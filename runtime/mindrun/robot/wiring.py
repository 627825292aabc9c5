"""What is wired to what: each sensor and actuator of a mind with its driver, and how their values become 0..1 and back.

It comes from `robot.yaml` and travels in the bundle, checked against the mind by the compiler.
"""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import NUMBER, RATIO, SECONDS, Quantity, Reference
from mindrun.robot.contract import ActuatorDriver, SensorDriver

ODD = Quantity("an odd number of values", {"": 1.0}, low=1, high=15, whole=True)
HERTZ = Quantity("a rate", {"Hz": 1.0}, low=0.01, high=1000)
A_SECOND = Quantity("a share of the travel in a second", {"": 1.0}, low=0.0)
ON_FAULT = Reference("reaction", ("neutral", "hold", "blank"))


@dataclass(frozen=True, slots=True)
class SensorWire:
    """How a sensor is measured.

    Its reading is 0 at the value `low` and 1 at `high`, which may be the smaller one; `median` of so many values is
    taken, `rate` times a second. What was measured more than `max_age` ago, or failed, is a fault: then every actuator
    goes to neutral (`on_fault` "neutral"), the reading before is held for `hold` seconds more ("hold"), or it reads
    `blank`, as where there is nothing to measure ("blank").
    """

    sensor: str
    driver: SensorDriver
    low: Annotated[float, NUMBER]
    high: Annotated[float, NUMBER]
    median: Annotated[int, ODD] = 1
    rate: Annotated[float, HERTZ] = 20.0
    max_age: Annotated[float, SECONDS] = 0.25
    on_fault: Annotated[str, ON_FAULT] = "neutral"
    hold: Annotated[float, SECONDS] = 0.5
    blank: Annotated[float, RATIO] = 1.0


@dataclass(frozen=True, slots=True)
class ActuatorWire:
    """How an actuator is commanded.

    A command c becomes c + `trim`, kept within `low` and `high` and changed by no more than `slew` a second (0: at
    once), and turned round where it is `reversed`. Neutral is the mind's, and is sent as it is, at once.
    """

    actuator: str
    driver: ActuatorDriver
    trim: Annotated[float, NUMBER] = 0.0
    low: Annotated[float, RATIO] = 0.0
    high: Annotated[float, RATIO] = 1.0
    slew: Annotated[float, A_SECOND] = 0.0
    reversed: bool = False


@dataclass(frozen=True, slots=True)
class Wiring:
    """A robot: every physical sensor and every actuator of one mind, in the order of its graph."""

    robot: str
    sensors: tuple[SensorWire, ...]
    actuators: tuple[ActuatorWire, ...]
