"""Teaching one lesson after the other, with something to look at, and keeping what was learnt."""

import json
import secrets
import signal
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from threading import Event, Thread
from time import perf_counter
from types import FrameType

from mindrun.kinds.learners import run_lengths
from mindrun.processors import cores, cpu_seconds
from mindrun.sim.rollout import Rollout
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.attempts import NOTHING_AHEAD, Ahead, AttemptExecutor
from mindrun.train.lesson_state import LessonState, Record, is_over
from mindrun.train.population import founder_count
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder, open_run, read_result
from mindrun.train.scoring import Scorer
from mindrun.train.training import Watch, train
from rich.console import Console, ConsoleOptions, RenderableType
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from mindlang.cli._session import ensure_compiled
from mindlang.cli._terminal import console, load_compiled, procedures_talk, tell
from mindlang.executors import Where
from mindlang.executors.jobs import JobScorer
from mindlang.lock import LockError
from mindlang.number_format import duration, rate, short_score
from mindlang.training.event_files import EventFiles
from mindlang.training.lesson_choice import TrainOptions, lessons_to_teach
from mindlang.training.lock_update import Kept
from mindlang.training.subject import Subject, begin_run, open_subject, refuse_changed
from mindlang.training.teaching import Result, finish, make_again, opening, outcome, rollout_of, workers_of

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


@dataclass(frozen=True, slots=True)
class Trainer:
    """Teaches on so many cores (all where None); talks on stderr and, with `as_json`, prints results on stdout.

    Where `where` says of workers elsewhere, they do the attempts of each lesson, or of a single one the runs.
    With `event_files` it writes those of TensorBoard, too.
    """

    workers: int | None
    as_json: bool
    quiet: bool
    where: Where | None = None
    event_files: bool = False

    def teach_file(
        self,
        file: Path,
        skills: Sequence[str],
        curriculum: str | None,
        options: TrainOptions,
        force: bool,
        seed: int | None,
        runs: Path,
    ) -> bool:
        """Teach the lessons that are due, or those asked for; False if it was interrupted."""
        seed = secrets.randbits(31) if seed is None else seed
        due = lessons_to_teach(file, load_compiled(file), curriculum, skills, options, force, self._say)
        for subject, lesson in due:
            run = begin_run(subject, lesson, seed, runs, datetime.now(UTC), ("mindc", *sys.argv[1:]))
            if not self._teach(run, subject, force):
                return False
        return True

    def resume(self, folder: Path, force: bool) -> bool:
        """Go on with a run; False if it was interrupted."""
        run = open_run(folder)
        source = Path(run.manifest.source)
        if not source.exists():
            raise RunError(f"{source}, from which this run began, is gone", f"its text is in {folder / 'source'}")
        subject = open_subject(source, load_compiled(source))
        refuse_changed(subject, run)
        return self._teach(run, subject, force)

    def _teach(self, run: RunFolder, subject: Subject, force: bool) -> bool:
        if (result := read_result(run.folder)) is not None:
            if self.event_files:
                EventFiles(run).write_all()
            self._say(f"{run.folder} has finished already")
            self._print(result)
            return True
        rollout = self._rollout(run, subject)
        said, cpu_begin = rollout.notes, cpu_seconds()
        by = self.where, self.workers or cores(), self._say, perf_counter
        with workers_of(run, subject, rollout, *by) as (scorer, executor):
            pace = TimeLeft.of(run, perf_counter())
            try:
                state = self._watched(run, scorer, executor, pace)
            except StoppedWhileIdleError:
                state = None
            if state is None or not is_over(run.manifest.lesson, state):
                tell(f"saved; to go on: {self._command(run)}")
                return False
            self._say(*(f"note: {note}" for note in rollout.notes if note not in said))
            result, kept = self._finished(run, subject, state, scorer, force, rollout.notes)
        spent = None if self.where else cpu_seconds() - cpu_begin  # nobody knows what others have
        result |= {
            "cpu_seconds": None if spent is None else round(spent, 3),
            "ticks_per_cpu_second": None if spent is None else round(pace.ticks / max(spent, 1e-3)),
        }
        self._say(*outcome(run, result, kept, subject.keep_path(run.manifest.lesson).name))
        self._say(*(f"note: {note}" for note in result["notes"] if note not in rollout.notes))
        self._print(result)
        return True

    @procedures_talk()
    def _finished(
        self, run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, force: bool, notes: Sequence[str]
    ) -> tuple[Result, Kept]:
        try:
            return finish(run, subject, state, scorer, force, self.workers or cores(), notes)
        except LockError as error:
            hint = f"what was learnt is safe; mend that, then: {self._command(run)}"
            raise RunError(str(error), hint) from error

    @procedures_talk()
    def _rollout(self, run: RunFolder, subject: Subject) -> Rollout:
        self._say(opening(run))
        if self.event_files:
            self._say(f"to watch: {command_line('tensorboard', '--logdir', run.folder)}")
        rollout = rollout_of(run, subject, self.workers or cores())
        ensure_compiled(rollout, self._say)  # before the clock of the lesson starts
        make_again(run, rollout)
        self._say(*(f"note: {note}" for note in rollout.notes))
        return rollout

    @procedures_talk()
    def _watched(self, run: RunFolder, scorer: Scorer, executor: AttemptExecutor | None, pace: TimeLeft) -> LessonState:
        generations = run.manifest.lesson.generations
        display = None if self.quiet else LessonDisplay(console(stderr=True), run.manifest.name, pace)
        event_files = EventFiles(run) if self.event_files else None
        asked = Event()

        # A thread, for the signal may come in the middle of a print.
        saying = Thread(target=self._say_stopping, args=(run, display, executor is not None), daemon=True)

        def stop(number: int, frame: FrameType | None) -> None:
            """Stop after this generation; at the next Ctrl-C at once, even where compiled code runs no handler."""
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            asked.set()
            if isinstance(scorer, JobScorer) and not scorer.jobs.has_begun:
                raise StoppedWhileIdleError
            saying.start()

        def report(state: LessonState, record: Record) -> None:
            has_ended = record.verdict is not None
            done = record.attempt * generations if has_ended else (record.attempt - 1) * generations + record.generation
            now = perf_counter()
            standing = pace.standing(record, done, now)
            if display:
                display.report(standing, done, now)
            if event_files:
                event_files.report(record, now)

        before = signal.signal(signal.SIGINT, stop)
        try:
            watch = Watch(report, self._say, asked.is_set, perf_counter, pace.count_ahead)
            return train(run, scorer, watch, executor)
        finally:
            signal.signal(signal.SIGINT, before)
            if saying.is_alive():
                saying.join()
            for each in (display, event_files):
                if each:
                    each.close()

    def _say_stopping(self, run: RunFolder, display: LessonDisplay | None, is_elsewhere: bool) -> None:
        if display:
            display.close()
        what = "saving; what workers are at is done again then" if is_elsewhere else "finishing this generation"
        self._say(f"{what}; Ctrl-C again stops at once, to go on then: {self._command(run)}")

    def _command(self, run: RunFolder) -> str:
        """The command that goes on with a run."""
        return command_line("mindc", "train", "--resume", run.folder) + " --tensorboard" * self.event_files

    def _say(self, *lines: str) -> None:
        if not self.quiet:
            tell(*lines)

    def _print(self, result: Result) -> None:
        if self.as_json:
            print(json.dumps(result, allow_nan=False), flush=True)


class StoppedWhileIdleError(KeyboardInterrupt):
    """A run is to be stopped before anybody is at work: there is nothing to wait for."""
