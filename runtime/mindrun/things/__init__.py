"""Kinds of what a task's world contains, one file each."""

from mindrun.registry import register_all
from mindrun.things.ball import Ball
from mindrun.things.item import Item
from mindrun.things.loose_box import LooseBox
from mindrun.things.map import Map
from mindrun.things.obstacle import Obstacle
from mindrun.things.power import Power
from mindrun.things.thing import MOVES, OUTCOMES, STAYS, VANISHES, Outcome, ThingKind
from mindrun.things.walker import Walker
from mindrun.things.wall import Wall
from mindrun.things.zone import Zone

register_all(__name__, __path__)

__all__ = [
    "MOVES", "OUTCOMES", "STAYS", "VANISHES", "Ball", "Item", "LooseBox", "Map", "Obstacle", "Outcome",
    "Power", "ThingKind", "Walker", "Wall", "Zone",
]  # fmt: skip
