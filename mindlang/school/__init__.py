"""Teaching one lesson after the other, with something to look at, and keeping what was learnt."""

import json
import secrets
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter

from mindrun.graph import Lesson
from mindrun.sim.rollout import Rollout, cores
from mindrun.train.errors import RunError
from mindrun.train.lesson import Record, State
from mindrun.train.population import founder_count
from mindrun.train.run_folder import Run, keep_result, open_run, read_result
from mindrun.train.training import Watch, train
from mindrun.weights import learners

from mindlang.lock import LockError
from mindlang.resource_limits import refuse_too_large, refuse_too_long
from mindlang.school.book import Book, begin, open_book, refuse_changed
from mindlang.school.interruption import Interruption
from mindlang.school.keeping import Kept, keep
from mindlang.school.results import Result, opening, outcome, result_of
from mindlang.school.teaching import Wishes, is_due, lessons
from mindlang.school.watching import Bar, Lines, Pace, Silent, Watcher
from mindlang.simulator_compilation import make_ready
from mindlang.terminal import load_compiled, procedures_talk, talk


@dataclass(frozen=True, slots=True)
class School:
    """Teaches on so many cores (all where None); talks on stderr and, with `as_json`, prints results on stdout."""

    workers: int | None
    as_json: bool
    quiet: bool

    def teach_file(
        self,
        file: Path,
        skills: Sequence[str],
        curriculum: str | None,
        wishes: Wishes,
        force: bool,
        seed: int | None,
        runs: Path,
    ) -> bool:
        """Teach the lessons that are due, or those asked for; False if it was interrupted."""
        seed = secrets.randbits(31) if seed is None else seed
        compiled = load_compiled(file)
        book = open_book(file, compiled)
        chosen = lessons(book.graph, curriculum, skills)
        if skills or force:
            _refuse_frozen(book, chosen)
        taught = frozen = 0
        for lesson in chosen:
            book = open_book(file, compiled)  # the lesson before has changed the lock
            if not (standing := book.standing(lesson)):
                frozen += 1
                self._say(f"{lesson.skill} is frozen, and is not taught")
            elif skills or force or is_due(book.graph, lesson, standing):
                run = begin(book, wishes.applied(lesson), seed, runs, datetime.now(UTC))
                taught += 1
                if not self._teach(run, book, force):
                    return False
        if not taught:
            others = "all other lessons" if frozen else f"all {len(chosen)} lessons"
            self._say(f"nothing to do: {others} have been taught (--force teaches them again)")
        return True

    def resume(self, folder: Path, force: bool) -> bool:
        """Go on with a run; False if it was interrupted."""
        run = open_run(folder)
        source = Path(run.manifest.source)
        if not source.exists():
            raise RunError(f"{source}, from which this run began, is gone", f"its text is in {folder / 'source'}")
        book = open_book(source, load_compiled(source))
        refuse_changed(book, run)
        return self._teach(run, book, force)

    def _teach(self, run: Run, book: Book, force: bool) -> bool:
        if (result := read_result(run.folder)) is not None:
            self._say(f"{run.folder} has finished already")
            self._print(result)
            return True
        rollout = self._rollout(run, book)
        state = self._watched(run, rollout)
        if state.attempt < run.manifest.lesson.learner.attempts:
            talk.print(f"saved; to go on: {_command(run)}", markup=False)
            return False
        kept = self._kept(run, book, state, rollout, force)
        result = result_of(run, state, kept)
        keep_result(run.folder, result)
        self._say(*outcome(run, result, kept, book.keep_path(run.manifest.lesson).name))
        self._print(result)
        return True

    @procedures_talk()
    def _kept(self, run: Run, book: Book, state: State, rollout: Rollout, force: bool) -> Kept:
        try:
            return keep(run, book, state, rollout, force)
        except LockError as error:
            hint = f"what was learnt is safe; mend that, then: {_command(run)}"
            raise RunError(str(error), hint) from error

    @procedures_talk()
    def _rollout(self, run: Run, book: Book) -> Rollout:
        lesson = run.manifest.lesson
        self._say(opening(run))
        rollout = Rollout(
            book.graph,
            run.weights,
            lesson.task,
            lesson.master,
            run.manifest.learners,
            procedures=book.folder,
            workers=self.workers or cores(),
        )
        learner = lesson.learner
        first = founder_count(learner)
        refuse_too_large(rollout, first, learner.layouts)
        refuse_too_long(rollout, (first + learner.population * (lesson.generations - 1)) * learner.layouts)
        make_ready(rollout, self._say)  # before the clock of the lesson starts
        return rollout

    @procedures_talk()
    def _watched(self, run: Run, rollout: Rollout) -> State:
        lesson = run.manifest.lesson
        watcher = self._watcher(run)

        def asked() -> None:
            watcher.close()
            self._say(f"finishing this generation; Ctrl-C again stops at once, to go on then: {_command(run)}")

        def report(state: State, record: Record) -> None:
            done = state.attempt * lesson.generations + state.population.generation
            watcher.report(record, done, perf_counter())

        try:
            with Interruption(asked) as interruption:
                return train(run, rollout, Watch(report, self._say, lambda: interruption.asked, perf_counter))
        finally:
            watcher.close()

    def _watcher(self, run: Run) -> Watcher:
        if self.quiet:
            return Silent()
        return (Bar if talk.is_terminal else Lines)(talk, run.manifest.name, Pace.of(run, perf_counter()))

    def _say(self, *lines: str) -> None:
        for line in () if self.quiet else lines:
            talk.print(line, markup=False)

    def _print(self, result: Result) -> None:
        if self.as_json:
            print(json.dumps(result, allow_nan=False), flush=True)


def _refuse_frozen(book: Book, chosen: Sequence[Lesson]) -> None:
    """RunError where a lesson has nobody to teach."""
    for lesson in chosen:
        if not learners(book.graph, lesson):
            hint = f"mindc edit unfreeze {lesson.skill} {book.shown} --write"
            raise RunError(f"{lesson.skill} is frozen", hint)


def _command(run: Run) -> str:
    """What goes on with a run."""
    return f"mindc train --resume {shlex.quote(str(run.folder))}"
