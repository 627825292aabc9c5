"""The compiler of `.mind` files, and their training, for programs and notebooks; what `mindc` does, it does with this.

    mind = mindlang.load("collect.mind")
    mind.diagnostics                                    # what is wrong, as values
    engine = mind.engine()                              # with what was taught
    commands = engine.tick(readings)

`Mind` has all of it. Nothing here prints, ends the program or reads its arguments.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mindlang.api import Mind as Mind
    from mindlang.api import load as load
    from mindlang.api import loads as loads

__all__ = ["Mind", "load", "loads"]


def __getattr__(name: str) -> Any:
    """The names of `mindlang.api`, imported when one is asked for: `mindc --help` should not wait for numpy."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from mindlang import api

    return getattr(api, name)
