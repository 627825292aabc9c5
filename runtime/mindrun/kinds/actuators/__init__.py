"""Kinds of actuators, one file each. `neutral` is sent when nothing influences one and whenever something fails."""

from mindrun.kinds.actuators.actuator import ActuatorKind, Side
from mindrun.kinds.actuators.gripper import Gripper
from mindrun.kinds.actuators.lamp import Lamp
from mindrun.kinds.actuators.motor import Motor
from mindrun.kinds.actuators.servo import Servo
from mindrun.kinds.actuators.steering import Steering
from mindrun.kinds.actuators.thruster import Thruster
from mindrun.kinds.actuators.wheel import Wheel
from mindrun.kinds.registry import register_all

register_all(__name__, __path__)

__all__ = ["ActuatorKind", "Gripper", "Lamp", "Motor", "Servo", "Side", "Steering", "Thruster", "Wheel"]
