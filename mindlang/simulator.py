"""Whether the simulator must still be compiled, which takes a while and happens once."""

from importlib import import_module
from pathlib import Path

WAIT = "compiling the simulator once (about half a minute)…"


def is_compiled() -> bool:
    """Whether the compiled simulator lies in numba's cache."""
    import_module("mindrun.sim.lanes.arithmetic")  # it tells numba where its cache is
    import numba

    return any(Path(numba.config.CACHE_DIR).rglob("advance.advance-*.nbc"))
