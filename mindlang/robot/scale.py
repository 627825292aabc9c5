"""What a sensor measures in metres, where the mind says how long a unit of its world is."""

from dataclasses import replace
from typing import Any

from mindrun.graph.graph import Sensor
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.numbers.quantity import fits
from mindrun.robot.driver_support import METRES

from mindlang.robot.driver import Wired
from mindlang.robot.options import driver_options
from mindlang.robot.timing import timing_of

RANGE = "range"  # an option of drivers


def seeing_as_far(wired: Wired, sensor: Sensor, unit_metres: float | None) -> Wired:
    """A driver whose range nobody says sees as far as the sensor of the mind."""
    option = next((each for each in driver_options(type(wired.driver)) if each.key == RANGE), None)
    metres = (unit_metres or 0.0) * sensor.kind.ends[1]
    is_length = sensor.kind.unit == wired.driver.unit != ""
    if not (metres and is_length) or option is None or option.type is not METRES or wired.entry(RANGE):
        return wired
    if not fits(METRES, metres):
        return wired
    driver: Any = replace(wired.driver, **{option.field: metres})
    return replace(wired, driver=driver, timing=timing_of(driver, wired.noun))


def usual_ends(wired: Wired, kind: SensorKind, unit_metres: float | None) -> tuple[float, float]:
    """The values of a driver that are the readings 0 and 1 where nobody says so: as long as in the mind's world.

    As the driver says where the mind does not say how long a unit is, or what it measures is no length and no speed.
    """
    low, high = kind.ends
    if unit_metres is None or kind.unit != wired.driver.unit or not kind.unit or wired.entry(RANGE):
        return float(wired.driver.usual[0]), float(wired.driver.usual[1])
    return low * unit_metres, high * unit_metres
