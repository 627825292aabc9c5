"""Kinds of actuators, one file each. `neutral` is sent when nothing influences one and whenever something fails."""

from mindrun.actuators.actuator import ActuatorKind, Side
from mindrun.actuators.gripper import Gripper
from mindrun.actuators.servo import Servo
from mindrun.actuators.wheel import Wheel
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["ActuatorKind", "Gripper", "Servo", "Side", "Wheel"]
