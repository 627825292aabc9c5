"""The progress of a lesson while it is taught: a bar on a terminal, a line now and then elsewhere."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mindrun.kinds.learners import run_lengths
from mindrun.train.attempts import NOTHING_AHEAD, Ahead
from mindrun.train.lesson_state import Record
from mindrun.train.population import founder_count
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder
from rich.console import Console, ConsoleOptions, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from mindlang.number_format import duration, rate, short_score

LINE_SECONDS = 5.0  # between two lines
MAX_BAR_COLUMNS, MIN_BAR_COLUMNS = 20, 8  # columns of a bar, the space behind it with the narrowest


@dataclass(frozen=True, slots=True)
class ProgressText:
    """The progress of a lesson after a generation, in parts; `briefly` is `where` in a few characters."""

    where: str
    briefly: str
    best: str
    reevaluated: str
    rate: str
    left: str

    def text(self) -> str:
        return self._with(self.where, self.best, self.reevaluated, self.rate)

    def shorter(self) -> Iterator[tuple[str, int]]:
        """Ever shorter texts, each with the columns that its bar needs; the time left is in all of them."""
        without_rate = self._with(self.where, self.best, self.reevaluated)
        yield self.text(), MIN_BAR_COLUMNS
        yield without_rate, MIN_BAR_COLUMNS
        yield without_rate, 0
        yield self._with(self.where, self.best), 0
        yield self._with(self.where), 0
        yield self._with(self.briefly), 0

    def _with(self, *parts: str) -> str:
        return ", ".join(filter(None, (*parts, self.left)))


@dataclass(slots=True)
class TimeLeft:
    """The pace of generations since this process took the lesson up at `began`; `generations` are of all attempts.

    `first` says how many generations the first one of an attempt is worth, with all its founders, and `lengths` until
    when runs are how long, as `run_lengths` does. `reevaluated` is the attempt, the generation and the score on fresh
    layouts of the last champion that has one. `ticks` were simulated.
    """

    generations: int
    began: float
    attempts: int = 1
    reevaluated: tuple[int, int, float] | None = None
    first: float = 1.0
    lengths: Sequence[tuple[float, float]] = ((1.0, 1.0),)
    ticks: int = 0
    seen: float = 0.0
    ahead: Ahead = NOTHING_AHEAD

    @classmethod
    def of(cls, run: RunFolder, began: float) -> "TimeLeft":
        """The pace of a run that is taken up, which may have scored before."""
        lesson = run.manifest.lesson
        known = None
        for row in read_progress(run.folder):
            if (score := row["reevaluated"]) is not None:
                known = int(row["attempt"] or 0), int(row["generation"] or 0), score
        learner = lesson.learner
        first = founder_count(learner) / learner.population if run.begins_with_nothing else 1.0
        lengths = run_lengths(learner)
        return cls(lesson.generations * learner.attempts, began, learner.attempts, known, first, lengths)

    def count_ahead(self, ahead: Ahead) -> None:
        """Take note of what attempts ahead of their turn have done by now."""
        self.ahead = ahead

    def share(self, done: int) -> float:
        """The share of all generations that has been done, in its turn or ahead."""
        return (done + self.ahead.generations) / self.generations

    def _worth(self, done: int) -> float:
        """How many generations of whole runs so many generations of all attempts are worth."""
        one, whole = self.generations // self.attempts, 0.0
        attempts, rest = divmod(done, one)
        begin = 0.0
        for length, share in self.lengths:
            end = share * one
            whole += length * (attempts * (end - begin) + min(max(rest - begin, 0.0), end - begin))
            begin = end
        return whole

    def standing(self, record: Record, done: int, now: float) -> ProgressText:
        """The progress after a generation, when `done` of all attempts have been made."""
        self.ticks += record.ticks
        one, all_of_one = self.generations // self.attempts, self._worth(self.generations) / self.generations
        more = (self.first - 1.0) * self.lengths[0][0]
        self.seen += (
            self._worth(record.generation) - self._worth(record.generation - 1) + more * (record.generation == 1)
        )
        ahead = self.ahead.generations * all_of_one + self.ahead.attempts * more
        left = self._worth(self.generations) - self._worth(done) + (self.attempts - record.attempt) * more - ahead
        everywhere = (self.seen + ahead) / self.seen  # times what has been done in its turn
        if record.reevaluated is not None:
            self.reevaluated = record.attempt, record.generation, record.reevaluated
        seconds = max(now - self.began, 1e-9)
        where, briefly = f"generation {record.generation} of {one}", f"{record.generation}/{one}"
        if self.attempts > 1:
            attempt = f"attempt {record.attempt}"
            where, briefly = f"{attempt} of {self.attempts}, {where}", f"{attempt}, {briefly}"
        if self.ahead.generations:
            where += f" and {self.ahead.generations:,} ahead"
        return ProgressText(
            where,
            briefly,
            f"best {short_score(record.best)}",
            self._reevaluated(record),
            rate(self.ticks * everywhere / seconds),
            f"{duration(seconds / (self.seen * everywhere) * max(0.0, left))} left",
        )

    def _reevaluated(self, record: Record) -> str:
        """The score of the best on fresh layouts, now or earlier in this attempt; "" where there is none."""
        attempt, generation, score = self.reevaluated or (0, 0, 0.0)
        if attempt != record.attempt:
            return ""
        when = "" if generation == record.generation else f" in generation {generation}"
        return f"re-evaluated {short_score(score)}{when}"


class LessonDisplay:
    """A progress bar that goes away when the lesson ends; where that is no terminal, a line every few seconds."""

    def __init__(self, console: Console, name: str, pace: TimeLeft) -> None:
        self._console, self._name, self._pace, self._due = console, name, pace, pace.began
        self._live: Live | None = None
        if console.is_terminal:
            self._live = Live(ProgressLine(name, None, 0.0), console=console, transient=True)
            self._live.start()

    def report(self, standing: ProgressText, done: int, now: float) -> None:
        """Move the bar, or print a line if the last one is long enough ago; one is for the last generation."""
        if self._live:
            self._live.update(ProgressLine(self._name, standing, self._pace.share(done)))
        elif now >= self._due or done == self._pace.generations:
            self._console.print(f"{self._name}: {standing.text()}", markup=False)
            self._due = now + LINE_SECONDS

    def close(self) -> None:
        """Take the bar away; the cursor is back."""
        if self._live:
            self._live.stop()


@dataclass(frozen=True, slots=True)
class ProgressLine:
    """A lesson's name, a bar, and as much of its progress as the terminal has columns for."""

    name: str
    standing: ProgressText | None
    share: float

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[RenderableType]:
        """The longest text that fits, and a bar in what it leaves; the last is wrapped rather than cut."""
        texts = list(self.standing.shorter()) if self.standing else [("the first generation …", 0)]
        text, room = texts[-1][0], 0
        for text, least in texts:
            room = options.max_width - len(self.name) - len(text) - 1
            if room >= least:
                break
        if room < MIN_BAR_COLUMNS:
            yield Text(f"{self.name} {text}", overflow="fold")
            return
        line = Table.grid(padding=(0, 1, 0, 0))
        line.add_row(self.name, ProgressBar(1.0, self.share, width=min(MAX_BAR_COLUMNS, room - 1)), text)
        yield line
