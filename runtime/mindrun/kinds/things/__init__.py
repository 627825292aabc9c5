"""Kinds of what a task's world contains, one file each."""

from mindrun.kinds.registry import register_all
from mindrun.kinds.things.ball import Ball
from mindrun.kinds.things.item import Item
from mindrun.kinds.things.loose_box import LooseBox
from mindrun.kinds.things.map import Map
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.power import Power
from mindrun.kinds.things.thing import MOVES, OUTCOMES, STAYS, VANISHES, Outcome, ThingKind
from mindrun.kinds.things.walker import Walker
from mindrun.kinds.things.wall import Wall
from mindrun.kinds.things.zone import Zone

register_all(__name__, __path__)

__all__ = [
    "MOVES", "OUTCOMES", "STAYS", "VANISHES", "Ball", "Item", "LooseBox", "Map", "Obstacle", "Outcome",
    "Power", "ThingKind", "Walker", "Wall", "Zone",
]  # fmt: skip
