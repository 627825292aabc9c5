"""Kinds of events, one file each: what can happen in a tick. `sim/lanes/judge.py` notices them."""

from mindrun.events.collision import Collision
from mindrun.events.delivery import Delivery
from mindrun.events.event import EventKind
from mindrun.events.exhaustion import Exhaustion
from mindrun.events.reach import Reach
from mindrun.events.success import Success
from mindrun.events.visit import Visit
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["Collision", "Delivery", "EventKind", "Exhaustion", "Reach", "Success", "Visit"]
