"""Kinds of sensors, one file each. On a robot a driver reads those that measure, and the engine computes the others.

Every reading is a real number in 0..1. `range` and `dead_zone` are as for a range finder where a kind has them.
"""

from mindrun.registry import register_all
from mindrun.sensors.average import Average
from mindrun.sensors.battery import Battery
from mindrun.sensors.bearing import Bearing
from mindrun.sensors.computed import Computed
from mindrun.sensors.contact import Contact
from mindrun.sensors.derivative import Derivative
from mindrun.sensors.held import Held
from mindrun.sensors.inertial import Inertial
from mindrun.sensors.inside import Inside
from mindrun.sensors.latch import Latch
from mindrun.sensors.range_finder import RangeFinder
from mindrun.sensors.reading import Reading
from mindrun.sensors.sensor import Physical, SensorKind
from mindrun.sensors.sine import Sine

register_all(__name__, __path__)

__all__ = [
    "Average", "Battery", "Bearing", "Computed", "Contact", "Derivative", "Held", "Inertial", "Inside", "Latch",
    "Physical", "RangeFinder", "Reading", "SensorKind", "Sine",
]  # fmt: skip
