"""Teaching one lesson after the other, with something to look at, and keeping what was learnt."""

import json
import secrets
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter
from types import FrameType
from typing import Any

from mindrun.processors import cores, cpu_seconds
from mindrun.sim.rollout import Rollout
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.attempts import AttemptExecutor
from mindrun.train.lesson_state import LessonState, Record
from mindrun.train.run_folder import RunFolder, open_run, read_result
from mindrun.train.scoring import Scorer
from mindrun.train.training import Watch, train

from mindlang.cli._simulator_compilation import ensure_compiled
from mindlang.cli._terminal import load_compiled, procedures_talk, talk
from mindlang.cli._training_progress import PrintedLines, ProgressBarLine, Silent, TimeLeft, Watcher
from mindlang.executors import Where
from mindlang.executors.jobs import JobScorer
from mindlang.lock import LockError
from mindlang.training.event_files import EventFiles
from mindlang.training.lesson_choice import TrainOptions, chosen_lessons
from mindlang.training.results import Result, opening, outcome
from mindlang.training.subject import Subject, begin_run, open_subject, refuse_changed, refuse_frozen
from mindlang.training.teaching import TeachingResult, finish, has_ended, make_again, rollout_of, workers_of


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
        compiled = load_compiled(file)
        subject = open_subject(file, compiled)
        chosen = chosen_lessons(subject.graph, curriculum, skills, subject.trained)
        if skills or force:
            refuse_frozen(subject, chosen)
        command = ("mindc", *sys.argv[1:])
        taught = frozen = 0
        for lesson in chosen:
            subject = open_subject(file, compiled)  # the lesson before has changed the lock
            if not subject.standing(lesson):
                frozen += 1
                self._say(f"{lesson.skill} is frozen, and is not taught")
            elif force or subject.takes(lesson, bool(skills)):
                wished = options.applied(lesson)
                if lesson.needs and not wished.needs:
                    self._say(f"{lesson.skill} has fewer generations than its lesson says: nothing is needed of it")
                run = begin_run(subject, wished, seed, runs, datetime.now(UTC), command)
                taught += 1
                if not self._teach(run, subject, force):
                    return False
        if not taught:
            self._say(_nothing_to_do(len(chosen), frozen > 0))
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
        said = rollout.notes
        by = self.where, self.workers or cores(), self._say, perf_counter
        counted, cpu_begin = CountedTicks(), cpu_seconds()
        with workers_of(run, subject, rollout, *by) as (scorer, executor):
            try:
                state = self._watched(run, scorer, executor, counted)
            except StoppedError:
                state = None
            if state is None or not has_ended(run, state):
                talk.print(f"saved; to go on: {self._command(run)}", markup=False)
                return False
            self._say(*(f"note: {note}" for note in rollout.notes if note not in said))
            taught = self._finished(run, subject, state, scorer, force, rollout.notes)
            result = taught.result | counted.rate(None if self.where else cpu_seconds() - cpu_begin)
        self._say(*outcome(run, result, taught.kept, subject.keep_path(run.manifest.lesson).name))
        self._print(result)
        return True

    @procedures_talk()
    def _finished(
        self, run: RunFolder, subject: Subject, state: LessonState, scorer: Scorer, force: bool, notes: Sequence[str]
    ) -> TeachingResult:
        try:
            return finish(run, subject, state, scorer, force, notes)
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
    def _watched(
        self, run: RunFolder, scorer: Scorer, executor: AttemptExecutor | None, counted: "CountedTicks"
    ) -> LessonState:
        lesson = run.manifest.lesson
        pace = TimeLeft.of(run, perf_counter())
        watcher = self._watcher(run, pace)
        watchers = [watcher, *[EventFiles(run)] * self.event_files]

        def asked() -> None:
            watcher.close()
            if isinstance(scorer, JobScorer) and not scorer.jobs.has_begun:
                raise StoppedError
            what = "saving; what workers are at is done again then" if executor else "finishing this generation"
            self._say(f"{what}; Ctrl-C again stops at once, to go on then: {self._command(run)}")

        def report(state: LessonState, record: Record) -> None:
            counted.ticks += record.ticks
            before = record.attempt if record.verdict is not None else record.attempt - 1
            done = before * lesson.generations + (record.generation if record.verdict is None else 0)
            for each in watchers:
                each.report(record, done, perf_counter())

        try:
            with Interruption(asked) as interruption:
                watch = Watch(report, self._say, lambda: interruption.asked, perf_counter, pace.count_ahead)
                return train(run, scorer, watch, executor)
        finally:
            for each in watchers:
                each.close()

    def _watcher(self, run: RunFolder, pace: TimeLeft) -> Watcher:
        if self.quiet:
            return Silent()
        return (ProgressBarLine if talk.is_terminal else PrintedLines)(talk, run.manifest.name, pace)

    def _command(self, run: RunFolder) -> str:
        """What goes on with a run."""
        return command_line("mindc", "train", "--resume", run.folder) + " --tensorboard" * self.event_files

    def _say(self, *lines: str) -> None:
        for line in () if self.quiet else lines:
            talk.print(line, markup=False)

    def _print(self, result: Result) -> None:
        if self.as_json:
            print(json.dumps(result, allow_nan=False), flush=True)


def _nothing_to_do(lessons: int, others_are_frozen: bool) -> str:
    if lessons == 1 and not others_are_frozen:
        return "nothing to do: its lesson has been taught (--force teaches it again)"
    which = "all other lessons" if others_are_frozen else f"all {lessons} lessons"
    return f"nothing to do: {which} have been taught (--force teaches them again)"


@dataclass(slots=True)
class CountedTicks:
    """What was simulated since a run was begun, or gone on with, here."""

    ticks: int = 0

    def rate(self, cpu_seconds: float | None) -> dict[str, float | None]:
        """For a result, where it is known how much time of processors that took."""
        return {
            "cpu_seconds": None if cpu_seconds is None else round(cpu_seconds, 3),
            "ticks_per_cpu_second": None if cpu_seconds is None else round(self.ticks / max(cpu_seconds, 1e-3)),
        }


class StoppedError(KeyboardInterrupt):
    """Nobody is at work yet, so that there is nothing to wait for when a run is to be stopped."""


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
