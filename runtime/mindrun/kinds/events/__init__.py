"""Kinds of events, one file each: what can happen in a tick. `sim/lanes/judge.py` notices them."""

from mindrun.kinds.events.collision import Collision
from mindrun.kinds.events.delivery import Delivery
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.events.exhaustion import Exhaustion
from mindrun.kinds.events.reach import Reach
from mindrun.kinds.events.success import Success
from mindrun.kinds.events.visit import Visit
from mindrun.kinds.registry import register_all

register_all(__name__, __path__)

__all__ = ["Collision", "Delivery", "EventKind", "Exhaustion", "Reach", "Success", "Visit"]
