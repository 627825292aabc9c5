"""Units compiled by processes of their own, side by side: numba stays out of this one."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from mindrun.processors import cores
from mindrun.sim import cache
from mindrun.sim.machine_code import target
from mindrun.sim.units import Unit

IN_BACKGROUND = "behind"
MOST_PROCESSES = 4  # side by side: each has to begin


def compile_missing(units: Iterable[Unit], told: Callable[[], None] = lambda: None) -> None:
    """Compile those of some units of which there is no machine code, on every core; `told` is called after each."""
    _compile(cache.missing(units), lambda unit: cache.find(unit) is not None, told)


def compile_natively(units: Iterable[Unit], told: Callable[[], None] = lambda: None) -> None:
    """Compile some units for this very processor, whatever was shipped."""
    _compile([each for each in units if not cache.is_native(each)], cache.is_native, told)


def compile_in_background() -> None:
    """Begin to compile all units for this very processor, and go on when this process ends."""
    if cache.lasts():
        _begin(IN_BACKGROUND, own_session=True)


def _compile(missing: Sequence[Unit], is_made: Callable[[Unit], bool], told: Callable[[], None]) -> None:
    names, waiting, processes = [each.name for each in missing], [*missing], list[subprocess.Popen[bytes]]()
    try:
        for _ in range(min(cores(), MOST_PROCESSES, len(missing)) if cache.folder().is_dir() else 0):
            processes += _begin(*names)
        are_at_work = bool(processes)
        while are_at_work:
            time.sleep(cache.ASK_AGAIN_SECONDS)
            are_at_work = any(each.poll() is None for each in processes)
            for unit in [each for each in waiting if is_made(each)]:
                waiting.remove(unit)
                told()
    finally:
        for each in processes:
            each.kill()
            each.wait()


def _begin(*words: str, own_session: bool = False) -> "list[subprocess.Popen[bytes]]":
    """A process of `warmup`, in a session of its own where it goes on by itself; none where none can begin.

    What is imported here is found there, and nothing else: -P. Of what numba may be told only the target counts.
    """
    known = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    kind = {"NUMBA_CPU_NAME": target().processor, "NUMBA_CPU_FEATURES": target().features}
    place = {"NUMBA_CACHE_DIR": str(cache.folder().parent)}
    path = {"PYTHONPATH": os.pathsep.join(each or f"{Path.cwd()}" for each in sys.path)}
    nowhere = subprocess.DEVNULL
    with suppress(OSError):
        return [subprocess.Popen(
            [sys.executable, "-P", "-m", "mindrun.sim.warmup", *words], env=known | kind | place | path,
            stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=own_session,
        )]  # fmt: skip
    return []
