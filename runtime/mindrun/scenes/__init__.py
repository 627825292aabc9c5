"""Kinds of scenes, one file each: the borders of a task's world, and where the robot starts."""

from mindrun.registry import register_all
from mindrun.scenes.arena import Arena
from mindrun.scenes.plain import Plain
from mindrun.scenes.scene import SceneKind

register_all(__name__, __path__)

__all__ = ["Arena", "Plain", "SceneKind"]
