"""Units compiled by several processes side by side."""

import os
import subprocess
import sys
from collections.abc import Callable, Sequence

from mindrun.processors import cores
from mindrun.sim import cache
from mindrun.sim.machine_code import target
from mindrun.sim.units import Unit

IN_BACKGROUND = "behind"
MOST_PROCESSES = 4  # side by side: each has to begin


def start(*words: str) -> "subprocess.Popen[bytes]":
    """A process that compiles all units, or some, for this very processor, and goes on when this one ends."""
    environment = os.environ | {"NUMBA_CPU_NAME": target().processor, "NUMBA_CPU_FEATURES": target().features}
    command, nowhere = [sys.executable, "-m", "mindrun.sim.warmup", *words], subprocess.DEVNULL
    return subprocess.Popen(
        command, env=environment, stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=True
    )


def make_missing(units: Sequence[Unit], told: Callable[[int, int], None] = lambda done, count: None) -> None:
    """Compile those of some units of which there is no machine code, on every core; `told` is told how many are done."""
    missing = [each for each in units if cache.find(each) is None]
    others = [start(*(each.name for each in missing)) for _ in range(min(cores(), MOST_PROCESSES, len(missing)) - 1)]
    done = iter(range(1, len(missing) + 1))
    try:
        cache.make_missing(missing, lambda: told(next(done), len(missing)))
    finally:
        for each in others:
            each.kill()
            each.wait()
