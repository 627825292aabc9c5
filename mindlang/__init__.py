"""The compiler of `.mind` files, and their training, for programs and notebooks; what `mindc` does, it does with this.

    mind = mindlang.load("collect.mind")
    mind.diagnostics                                    # what is wrong, as values
    engine = mind.engine()                              # with what was taught
    commands = engine.tick(readings)

`Mind` has all of it. Nothing here prints, ends the program or reads its arguments.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mindrun.errors import MindError as MindError
    from mindrun.train.lesson_state import Record as Record

    from mindlang.api import EditedMind as EditedMind
    from mindlang.api import Mind as Mind
    from mindlang.api import load as load
    from mindlang.api import loads as loads
    from mindlang.compiler.diagnostic import Diagnostic as Diagnostic
    from mindlang.training.lesson_choice import TrainOptions as TrainOptions

_HOMES = {
    "mindlang.api": ("EditedMind", "Mind", "load", "loads"),
    "mindlang.compiler.diagnostic": ("Diagnostic",),
    "mindlang.training.lesson_choice": ("TrainOptions",),
    "mindrun.errors": ("MindError",),
    "mindrun.train.lesson_state": ("Record",),
}
__all__ = ["Diagnostic", "EditedMind", "Mind", "MindError", "Record", "TrainOptions", "load", "loads"]


def __getattr__(name: str) -> Any:
    """A public name, from the module in which it stands: `mindc --help` should not wait for numpy."""
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(home), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
