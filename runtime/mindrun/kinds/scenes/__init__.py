"""Kinds of scenes, one file each: the borders of a task's world, and where the robot starts."""

from mindrun.kinds.registry import register_all, share_kinds
from mindrun.kinds.scenes.arena import Arena
from mindrun.kinds.scenes.gymnasium import Gymnasium
from mindrun.kinds.scenes.plain import Plain
from mindrun.kinds.scenes.scene import TOUCHING_UNITS, SceneKind

register_all(__name__, __path__)
share_kinds("scene", of="task")

__all__ = ["TOUCHING_UNITS", "Arena", "Gymnasium", "Plain", "SceneKind"]
