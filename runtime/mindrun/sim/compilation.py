"""Units compiled by processes of their own, side by side: numba stays out of this one."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence

from mindrun.processors import cores
from mindrun.sim import cache
from mindrun.sim.machine_code import target
from mindrun.sim.units import Unit

IN_BACKGROUND = "behind"
MOST_PROCESSES = 4  # side by side: each has to begin


def compile_missing(units: Iterable[Unit], told: Callable[[], None] = lambda: None) -> None:
    """Compile those of some units of which there is no machine code, on every core; `told` is called after each."""
    _compile([each for each in units if cache.find(each) is None], lambda unit: cache.find(unit) is not None, told)


def compile_natively(units: Iterable[Unit], told: Callable[[], None] = lambda: None) -> None:
    """Compile some units for this very processor, whatever was shipped."""
    _compile([each for each in units if not cache.is_native(each)], cache.is_native, told)


def compile_in_background() -> None:
    """Begin to compile all units for this very processor, and go on when this process ends."""
    _process(IN_BACKGROUND, own_session=True)


def _compile(missing: Sequence[Unit], is_made: Callable[[Unit], bool], told: Callable[[], None]) -> None:
    names, waiting = [each.name for each in missing], [*missing]
    processes = [_process(*names) for _ in range(min(cores(), MOST_PROCESSES, len(missing)))]
    try:
        while any(each.poll() is None for each in processes):
            time.sleep(cache.ASK_AGAIN_SECONDS)
            for unit in [each for each in waiting if is_made(each)]:
                waiting.remove(unit)
                told()
    finally:
        for each in processes:
            each.kill()
            each.wait()


def _process(*words: str, own_session: bool = False) -> "subprocess.Popen[bytes]":
    """A process of `warmup`, in a session of its own where it goes on by itself."""
    kind = {"NUMBA_CPU_NAME": target().processor, "NUMBA_CPU_FEATURES": target().features}
    place = {"NUMBA_CACHE_DIR": str(cache.folder().parent)}
    nowhere = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-m", "mindrun.sim.warmup", *words],
        env=os.environ | kind | place, stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=own_session,
    )  # fmt: skip
