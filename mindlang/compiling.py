"""Whether the simulator must still be compiled, which takes a while and happens once."""

from pathlib import Path

WAIT = "compiling the simulator once (about half a minute)…"


def is_compiled() -> bool:
    """Whether the compiled simulator lies in numba's cache."""
    import numba
    from mindrun.sim.lanes import arithmetic  # says where the cache is

    assert arithmetic.entry
    return any(Path(numba.config.CACHE_DIR).rglob("advance.advance-*.nbc"))
