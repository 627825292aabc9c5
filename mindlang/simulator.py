"""The simulator, compiled before it is needed: that takes a while, and happens once."""

import os
import signal
from collections.abc import Callable
from typing import Any

from mindrun.sim import warmup
from mindrun.sim.rollout import Rollout

from mindlang.terminal import INTERRUPTED

WAIT = "compiling the simulator once (about half a minute)…"


def is_compiled() -> bool:
    """Whether numba has a compiled simulator that it would take: one of these very files, where they lie now."""
    from mindrun.sim.lanes.advance import advance

    dispatcher: Any = advance
    return bool(dispatcher._cache.is_there())


def make_ready(rollout: Rollout, say: Callable[[str], None]) -> None:
    """Compile the simulator if need be, and say so; Ctrl-C ends the program meanwhile, because numba may swallow it."""
    if not is_compiled():
        say(WAIT)
    before = signal.signal(signal.SIGINT, lambda number, frame: os._exit(INTERRUPTED))
    try:
        rollout.compile()
    finally:
        signal.signal(signal.SIGINT, before)
    if is_compiled() and not warmup.is_native():  # it was shipped, for any processor of its kind
        warmup.start(warmup.BEHIND)
