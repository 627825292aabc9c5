"""A line on standard error that is rewritten, below the sentences that stay; nobody waits for who reads it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock
from time import monotonic

from mindrun.files.printable import visible
from mindrun.terminal.standard_streams import draw, error_columns, is_error_read

PLAIN_SECONDS = 10.0  # from one line to the next, where there is no terminal that could rewrite one
CLEAR = "\r\033[K"  # back to the beginning of the line, and nothing behind it


@dataclass(slots=True)
class StatusLine:
    """`say` prints a sentence. Any thread may tell or show."""

    say: Callable[[str], None]
    clock: Callable[[], float] = monotonic
    columns: Callable[[], int | None] = error_columns
    _is_shown: bool = False
    _last: float = field(default=float("-inf"))
    _lock: Lock = field(default_factory=Lock, repr=False)

    def tell(self, sentence: str) -> None:
        """Print a sentence that stays."""
        with self._lock:
            if self._is_shown:
                draw(CLEAR)
                self._is_shown = False
            self.say(sentence)

    def show(self, line: str) -> None:
        """Rewrite the line, cut where the terminal ends; on no terminal print it, but not often.

        A terminal that is paused gets no more of them: sentences that wait would be lost.
        """
        columns = self.columns()
        with self._lock:
            if columns is None:
                if self.clock() - self._last >= PLAIN_SECONDS:
                    self._last = self.clock()
                    self.say(line)
            elif is_error_read():
                draw(CLEAR + visible(line)[: columns - 1])
                self._is_shown = True

    def clear(self) -> None:
        """Remove the line."""
        with self._lock:
            if self._is_shown:
                draw(CLEAR)
                self._is_shown = False
