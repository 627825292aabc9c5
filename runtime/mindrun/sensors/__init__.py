"""Kinds of sensors, one file each. On a robot a driver reads those that measure, and the engine computes the others.

Every reading is a real number in 0..1. `range` and `dead_zone` are as for a range finder where a kind has them.
"""

from mindrun.registry import register_all
from mindrun.sensors.battery import Battery
from mindrun.sensors.bearing import Bearing
from mindrun.sensors.contact import Contact
from mindrun.sensors.derivative import Derivative
from mindrun.sensors.held import Held
from mindrun.sensors.inertial import Inertial
from mindrun.sensors.inside import Inside
from mindrun.sensors.range_finder import RangeFinder
from mindrun.sensors.sensor import Physical, SensorKind
from mindrun.sensors.sine import Sine

register_all(__name__, __path__)

__all__ = [
    "Battery", "Bearing", "Contact", "Derivative", "Held", "Inertial", "Inside", "Physical", "RangeFinder",
    "SensorKind", "Sine",
]  # fmt: skip
