"""Environments that do something to their process: `gymnasium tests.outside.deadly:deadly/WAY-PLACE-v0`.

No test imports this: what a program has registered itself is stepped in its own process.
"""

import ctypes
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import gymnasium

from tests.outside import worlds


def segmentation_fault() -> None:
    """As code in C makes one: in this thread, where a signal to the process may find another one some steps later."""
    signal.raise_signal(signal.SIGSEGV)


def print_twice() -> None:
    """On both ways to standard output."""
    print("from Python: ü")
    os.write(1, b"from C\n")


def take_signals() -> None:
    """What ends others ends this no more."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def leave_thread() -> None:
    """One that Python waits for at its end."""
    threading.Thread(target=threading.Event().wait).start()


def hold_interpreter() -> None:
    """As code in C that gives it to no other thread."""
    ctypes.PyDLL(None).sleep(1000)


WAYS: dict[str, Callable[[], object]] = {
    "Exit": partial(os._exit, 3),
    "Fault": segmentation_fault,
    "Leave": sys.exit,
    "Print": print_twice,
    "Signals": take_signals,
    "Thread": leave_thread,
    "Read": partial(os.read, 0, 1),
    "Hold": hold_interpreter,
    "Stop": lambda: os.kill(os.getpid(), signal.SIGSTOP),
    "Sleep": partial(time.sleep, 1000),
    "Doze": partial(time.sleep, 0.3),
}
PLACES = "make", "reset", "step", "render", "close"


class Deadly(worlds.Line):
    """Does it in one place: when it is made, when a run begins, in its third step, when it is drawn or closed."""

    def __init__(self, render_mode: str | None = None, way: str = "", place: str = "") -> None:
        self._way, self._place = way, place
        super().__init__(render_mode)
        self._do("make")

    def _do(self, place: str) -> None:
        if self._place == place:
            WAYS[self._way]()

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """As ever."""
        self._do("reset")
        return super().reset(seed=seed)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """As ever."""
        found = super().step(action)
        if self.steps == 3:
            self._do("step")
        return found

    def render(self) -> Any:
        """As ever."""
        self._do("render")
        return super().render()

    def close(self) -> None:
        """As ever; one that was made for its spaces alone has made no step."""
        if self.steps:
            self._do("close")
        super().close()


for way in WAYS:
    for place in PLACES:
        gymnasium.register(f"deadly/{way}-{place}-v0", Deadly, kwargs={"way": way, "place": place})
