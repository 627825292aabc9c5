"""What a user sees of a lesson while it is taught: a bar on a terminal, a line now and then elsewhere."""

from dataclasses import dataclass
from typing import Protocol

from mindrun.train.lesson import Record
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from mindlang.figures import duration, number, rate

SECONDS = 5.0  # between two lines


class Watcher(Protocol):
    """What is told of each generation; `done` counts the generations of all attempts."""

    def report(self, record: Record, done: int, now: float) -> None:
        """A generation has ended."""

    def close(self) -> None:
        """No more will come."""


class Silent:
    """Says nothing."""

    def report(self, record: Record, done: int, now: float) -> None:
        """Nothing."""

    def close(self) -> None:
        """Nothing."""


@dataclass(slots=True)
class Pace:
    """How fast generations pass since this process took the lesson up at `began`."""

    generations: int
    began: float
    ticks: int = 0
    seen: int = 0
    reevaluated: float | None = None

    def text(self, record: Record, done: int, now: float) -> str:
        """A generation as a line: where it is, its scores, the rate, the time left."""
        self.ticks += record.ticks
        self.seen += 1
        self.reevaluated = self.reevaluated if record.reevaluated is None else record.reevaluated
        seconds = max(now - self.began, 1e-9)
        left = seconds / self.seen * (self.generations - done)
        return (
            f"generation {done} of {self.generations}, best {number(record.best)}, "
            f"re-evaluated {number(self.reevaluated)}, {rate(self.ticks / seconds)}, {duration(left)} left"
        )


class Lines:
    """A line every few seconds, and one for the first and the last generation."""

    def __init__(self, console: Console, name: str, pace: Pace) -> None:
        self._console, self._name, self._pace = console, name, pace
        self._due = pace.began

    def report(self, record: Record, done: int, now: float) -> None:
        """Print a line if the last one is long enough ago."""
        text = self._pace.text(record, done, now)
        if now >= self._due or done == self._pace.generations:
            self._console.print(f"{self._name}: {text}", markup=False)
            self._due = now + SECONDS

    def close(self) -> None:
        """Nothing is open."""


class Bar:
    """A progress bar that goes away when the lesson ends."""

    def __init__(self, console: Console, name: str, pace: Pace) -> None:
        self._pace = pace
        columns = (TextColumn("{task.description}", markup=False), BarColumn(20), TextColumn("{task.fields[text]}"))
        self._progress = Progress(*columns, console=console, transient=True)
        self._task = self._progress.add_task(name, total=pace.generations, text="the first generation …")
        self._progress.start()

    def report(self, record: Record, done: int, now: float) -> None:
        """Move the bar."""
        self._progress.update(self._task, completed=done, text=self._pace.text(record, done, now))

    def close(self) -> None:
        """Take the bar away; the cursor is back."""
        self._progress.stop()
