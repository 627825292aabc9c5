"""Ctrl-C in two steps: the first asks for a stop at a good moment, the second stops at once."""

import signal
from collections.abc import Callable
from types import FrameType
from typing import Any


class Interruption:
    """While entered, the first SIGINT sets `asked` and calls `when_asked`; a second one ends the process."""

    def __init__(self, when_asked: Callable[[], None]) -> None:
        self.asked = False
        self._when_asked = when_asked

    def __enter__(self) -> "Interruption":
        self._before: Any = signal.signal(signal.SIGINT, self._first)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)

    def _first(self, number: int, frame: FrameType | None) -> None:
        # The default action, and no handler: compiled code may keep Python from running one for a while.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        self.asked = True
        self._when_asked()
