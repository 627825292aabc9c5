"""Environments that processes find by themselves: `gymnasium tests.outside.kept:Line-v0`, and what they do wrong."""

import time
from typing import Any

from tests.outside import worlds


class Hanging(worlds.Line):
    """The same, whose third step takes for ever."""

    def observed(self) -> Any:
        """Nothing, later on."""
        while self.steps == 3:
            time.sleep(0.01)
        return super().observed()


class Crowded(worlds.Line):
    """The same, whose third step takes for ever where many were made in the process, as in that of a worker."""

    made = 0

    def __init__(self, render_mode: str | None = None) -> None:
        super().__init__(render_mode)
        Crowded.made += 1

    def observed(self) -> Any:
        """Nothing, later on."""
        while self.steps == 3 and Crowded.made > 5:
            time.sleep(0.01)
        return super().observed()


class Dying(worlds.Line):
    """The same, whose third step ends the process, as a fault of machine code would."""

    def observed(self) -> Any:
        """Nothing, later on."""
        if self.steps == 3:
            import os

            os.abort()
        return super().observed()


class Talking(worlds.Line):
    """The same, which prints and reads what is not meant for it."""

    def observed(self) -> Any:
        """As ever; but it says so."""
        import os
        import sys

        print("step", self.steps)
        os.write(1, b"step\n")
        assert sys.stdin.read() == ""
        return super().observed()


class Threaded(worlds.Line):
    """The same, which leaves a thread that Python waits for at its end."""

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """As ever."""
        import threading

        threading.Thread(target=threading.Event().wait, daemon=False).start()
        return super().reset(seed=seed)


worlds.ALL = (*worlds.ALL, Hanging, Crowded, Dying, Talking, Threaded)  # type: ignore[assignment]
worlds.register()
