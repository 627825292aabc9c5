"""Kinds of actuators, one file each. `neutral` is sent when nothing influences one and whenever something fails."""

from mindrun.actuators.actuator import ActuatorKind, Side
from mindrun.actuators.gripper import Gripper
from mindrun.actuators.lamp import Lamp
from mindrun.actuators.motor import Motor
from mindrun.actuators.servo import Servo
from mindrun.actuators.steering import Steering
from mindrun.actuators.thruster import Thruster
from mindrun.actuators.wheel import Wheel
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["ActuatorKind", "Gripper", "Lamp", "Motor", "Servo", "Side", "Steering", "Thruster", "Wheel"]
