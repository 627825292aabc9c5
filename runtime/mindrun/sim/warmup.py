"""Machine code of the simulator, made ahead of its use: `python -m mindrun.sim.warmup [behind] [UNIT…]`."""

import fcntl
import signal
import sys
from collections.abc import Sequence

from mindrun.kinds.registry import kinds
from mindrun.processors import give_way
from mindrun.sim import cache
from mindrun.sim.compilation import IN_BACKGROUND
from mindrun.sim.kind_lanes import compute, read, remember, unit_of
from mindrun.sim.lanes import advance  # noqa: F401  whose units these are
from mindrun.sim.units import UNITS, Unit

LOWEST_NICENESS = 19  # how little a process matters that works while others wait for nothing


def every_unit() -> list[Unit]:
    """All units that there are, with those of every kind."""
    for noun, form in (("sensor", read), ("skill", compute), ("memory", remember)):
        for kind in kinds(noun).values():
            unit_of(kind, form)
    return [*UNITS.values()]


def main(words: Sequence[str]) -> None:
    """Compile, after any other process that does; with `behind`, at low priority, and not at all beside another one."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # numba may swallow an exception
    units = every_unit()
    if names := {*words} - {IN_BACKGROUND}:
        cache.make_missing(each for each in units if each.name in names)
        return
    with (cache.folder() / "warming").open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | (fcntl.LOCK_NB if IN_BACKGROUND in words else 0))
        except OSError:
            return
        if IN_BACKGROUND in words:
            give_way(LOWEST_NICENESS)
        cache.make_missing(units)


if __name__ == "__main__":
    main(sys.argv[1:])
