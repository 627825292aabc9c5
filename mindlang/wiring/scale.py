"""How far a sensor sees, in metres, where the mind says how long a unit of its world is."""

from dataclasses import replace
from typing import Any

from mindrun.graph import Sensor
from mindrun.quantity import fits
from mindrun.robot.driver_support import METRES
from mindrun.sensors import SensorKind

from mindlang.wiring.driver import Wired
from mindlang.wiring.options import driver_options

RANGE = "range"  # an argument of sensors, and an option of drivers


def seeing_as_far(wired: Wired, sensor: Sensor, unit_metres: float | None) -> Wired:
    """A driver whose range nobody says sees as far as the sensor of the mind."""
    option = next((each for each in driver_options(type(wired.driver)) if each.key == RANGE), None)
    metres = (unit_metres or 0.0) * _units(sensor.kind)
    if not metres or option is None or option.type is not METRES or wired.entry(RANGE) or not fits(METRES, metres):
        return wired
    driver: Any = replace(wired.driver, **{option.field: metres})
    return replace(wired, driver=driver)


def _units(kind: SensorKind) -> float:
    """How many units of the world away a sensor sees something; 0 where that is not so many."""
    return float(getattr(kind, RANGE, 0.0)) if kind.rays else 0.0
