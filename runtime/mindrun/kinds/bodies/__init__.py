"""Kinds of bodies, one file each: their outline, their mass, and what can move them."""

from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.bodies.box import Box
from mindrun.kinds.bodies.car import Car
from mindrun.kinds.bodies.disc import Disc
from mindrun.kinds.bodies.holonomic import Holonomic
from mindrun.kinds.registry import register_all

register_all(__name__, __path__)

__all__ = ["BodyKind", "Box", "Car", "Disc", "Holonomic"]
