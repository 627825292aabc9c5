"""Kinds of bodies, one file each: their outline, their mass, and what can move them."""

from mindrun.bodies.body import BodyKind
from mindrun.bodies.box import Box
from mindrun.bodies.car import Car
from mindrun.bodies.disc import Disc
from mindrun.bodies.holonomic import Holonomic
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["BodyKind", "Box", "Car", "Disc", "Holonomic"]
