"""A fixed rate on a monotonic clock, and how well it was kept."""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic, sleep

import numpy as np
from numpy.typing import NDArray

from mindrun.terminal.tick_count import ticks as in_words

LATENESS_BINS = 400  # of lateness, each a hundredth of a tick


@dataclass(slots=True)
class Rate:
    """Ticks at `begin + n·tick`; how late each began is counted. One that would begin a whole tick late is left out."""

    tick: float
    clock: Callable[[], float] = monotonic
    sleep: Callable[[float], None] = sleep
    ticks: int = 0
    missed: int = 0
    latest: float = 0.0
    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(LATENESS_BINS, np.int64))
    _due: float = 0.0

    def begin(self) -> None:
        """The first tick is due now."""
        self._due = self.clock()

    def wait(self) -> float:
        """Wait for the next tick; the time when it begins. A tick that is past is missed, not made up for."""
        now = self.clock()
        if now < self._due:
            self.sleep(self._due - now)
            now = self.clock()
        late = now - self._due
        skipped = int(late / self.tick)
        self.missed += skipped
        self.ticks += 1
        self.latest = max(self.latest, late)
        self.counts[min(LATENESS_BINS - 1, int(late / self.tick * 100))] += 1
        self._due += (skipped + 1) * self.tick
        return now

    def late(self, share: float) -> float:
        """How late the given share of the ticks began at most, in seconds, to a hundredth of a tick."""
        if not self.ticks:
            return 0.0
        place = int(np.searchsorted(np.cumsum(self.counts), share * self.ticks))
        return (min(place, LATENESS_BINS - 1) + 1) * self.tick / 100

    def __str__(self) -> str:
        if not self.ticks:
            return f"no tick of {self.tick * 1e3:.1f} ms"
        half, most = self.late(0.5) * 1e3, self.late(0.99) * 1e3
        kept = f"{in_words(self.ticks)} of {self.tick * 1e3:.1f} ms, {self.missed} missed"
        return f"{kept}; half began within {half:.1f} ms, 99 % within {most:.1f} ms of their time"
