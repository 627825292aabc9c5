"""Kinds of sensors, one file each. On a robot a driver reads those that measure, and the engine computes the others.

Every reading is a real number in 0..1. `range` and `dead_zone` are as for a range finder where a kind has them.
"""

from mindrun.kinds.registry import register_all
from mindrun.kinds.sensors.average import Average
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.bearing import Bearing
from mindrun.kinds.sensors.computed import Computed
from mindrun.kinds.sensors.contact import Contact
from mindrun.kinds.sensors.derivative import Derivative
from mindrun.kinds.sensors.held import Held
from mindrun.kinds.sensors.inertial import Inertial
from mindrun.kinds.sensors.inside import Inside
from mindrun.kinds.sensors.latch import Latch
from mindrun.kinds.sensors.range_finder import RangeFinder
from mindrun.kinds.sensors.reading import Reading
from mindrun.kinds.sensors.sensor import Physical, SensorKind
from mindrun.kinds.sensors.sine import Sine

register_all(__name__, __path__)

__all__ = [
    "Average", "Battery", "Bearing", "Computed", "Contact", "Derivative", "Held", "Inertial", "Inside", "Latch",
    "Physical", "RangeFinder", "Reading", "SensorKind", "Sine",
]  # fmt: skip
