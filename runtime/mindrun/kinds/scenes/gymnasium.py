"""A scene that is an environment of Gymnasium."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.numbers.quantity import Reference

ENVIRONMENT = Reference("environment")


@kind("task", "gymnasium")
class Gymnasium(SceneKind):
    """The environment of Gymnasium with that name: each tick is one of its steps, and it says how a run begins."""

    gymnasium: Annotated[str, ENVIRONMENT]

    @property
    def environment(self) -> str:
        """The environment's name, as Gymnasium has it."""
        return self.gymnasium
