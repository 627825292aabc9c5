"""Teaching one lesson after the other, with something to look at, and keeping what was learnt."""

import json
import secrets
import signal
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from threading import Event, Thread
from time import perf_counter
from types import FrameType

from mindrun.processors import cores, cpu_seconds
from mindrun.sim.rollout import Rollout
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.attempts import AttemptExecutor
from mindrun.train.lesson_state import LessonState, Record, is_over
from mindrun.train.run_folder import RunFolder, open_run, read_result
from mindrun.train.scoring import Scorer
from mindrun.train.training import Watch, train

from mindlang.cli._session import ensure_compiled
from mindlang.cli._terminal import console, load_compiled, procedures_talk, tell
from mindlang.cli._training_progress import LessonDisplay, TimeLeft
from mindlang.executors import Where
from mindlang.executors.jobs import JobScorer
from mindlang.lock import LockError
from mindlang.training.event_files import EventFiles
from mindlang.training.lesson_choice import TrainOptions, lessons_to_teach
from mindlang.training.lock_update import Kept
from mindlang.training.subject import Subject, begin_run, open_subject, refuse_changed
from mindlang.training.teaching import Result, finish, make_again, opening, outcome, rollout_of, workers_of


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
