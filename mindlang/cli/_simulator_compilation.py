"""The simulator, compiled before it is needed: that takes a while, and happens once."""

import os
import signal
from collections.abc import Callable, Iterable
from typing import Any

from mindrun.sim import warmup
from mindrun.sim.changed_ticks import STAGES
from mindrun.sim.lanes.advance import advance
from mindrun.sim.rollout import Rollout

from mindlang.cli._terminal import INTERRUPTED, say

COMPILING_STAGES = "compiling the stages of a tick once (about a minute)…"
COMPILING = "compiling the simulator once (about half a minute)…"


def is_compiled(entries: Iterable[Any] = (advance,)) -> bool:
    """Whether there is compiled code of these functions that numba would take: of these very files, kept or shipped."""
    return warmup.is_there(entries)


def prepare(rollout: Rollout) -> None:
    """Compile the simulator for a rollout, on standard error, before what needs it begins."""
    ensure_compiled(rollout, say)


def ensure_compiled(rollout: Rollout, say: Callable[[str], None]) -> None:
    """Compile the simulator if need be, and say so; Ctrl-C ends the program meanwhile, because numba may swallow it."""
    had = is_compiled(rollout.entries)
    if not had:
        say(COMPILING)
    before = signal.signal(signal.SIGINT, lambda number, frame: os._exit(INTERRUPTED))
    try:
        rollout.compile()
    finally:
        signal.signal(signal.SIGINT, before)
    if had and not warmup.is_native(rollout.entries):  # it was shipped, for any processor of its kind
        warmup.start(warmup.IN_BACKGROUND)


def ensure_stages_compiled(rollout: Rollout, say: Callable[[str], None]) -> None:
    """The same of the stages of a tick one by one, which runs with changes take."""
    if not is_compiled(STAGES):
        say(COMPILING_STAGES)
    before = signal.signal(signal.SIGINT, lambda number, frame: os._exit(INTERRUPTED))
    try:
        rollout.compile(*STAGES)
    finally:
        signal.signal(signal.SIGINT, before)
