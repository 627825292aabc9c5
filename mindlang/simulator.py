"""Whether the simulator must still be compiled, which takes a while and happens once."""

from typing import Any

WAIT = "compiling the simulator once (about half a minute)…"


def is_compiled() -> bool:
    """Whether numba has a compiled simulator that it would take: one of these very files, where they lie now."""
    from mindrun.sim.lanes.advance import advance

    dispatcher: Any = advance
    return bool(dispatcher._cache._cache_file._load_index())
