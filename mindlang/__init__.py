"""The compiler of `.mind` files, and their training, for programs and notebooks; what `mindc` does, it does with this.

    mind = mindlang.load("collect.mind")
    mind.diagnostics                                    # what is wrong, as values
    engine = mind.engine()                              # with what was taught
    commands = engine.tick(readings)

`Mind` has all of it. Nothing here prints, ends the program or reads its arguments.
"""

from typing import TYPE_CHECKING

from mindrun.lazy_import import lazy_names

if TYPE_CHECKING:
    from mindrun.errors import MindError as MindError
    from mindrun.train.lesson_state import Record as Record

    from mindlang.api import EditedMind as EditedMind
    from mindlang.api import Mind as Mind
    from mindlang.api import load as load
    from mindlang.api import loads as loads
    from mindlang.compiler.diagnostic import Diagnostic as Diagnostic
    from mindlang.pictures.training_plot import plot_training as plot_training
    from mindlang.training.lesson_choice import TrainOptions as TrainOptions

__getattr__ = lazy_names(
    __name__,
    {
        "mindlang.api": ("EditedMind", "Mind", "load", "loads"),
        "mindlang.compiler.diagnostic": ("Diagnostic",),
        "mindlang.pictures.training_plot": ("plot_training",),
        "mindlang.training.lesson_choice": ("TrainOptions",),
        "mindrun.errors": ("MindError",),
        "mindrun.train.lesson_state": ("Record",),
    },
)
__all__ = ["Diagnostic", "EditedMind", "Mind", "MindError", "Record", "TrainOptions", "load", "loads", "plot_training"]
