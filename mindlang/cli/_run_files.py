"""The files that a run is written to: a picture, a film, a table."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.errors import MindError
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.cli._run_session import RunSession
from mindlang.cli._terminal import MISUSE, fail, procedures_talk, refuse_unwritable, write_file
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.setup import RunSetup


@dataclass(frozen=True, slots=True)
class RunFiles:
    """Paths, None for what nobody asked for, and the speed of the film."""

    picture: Path | None
    video: Path | None
    speed: float | None
    trace: Path | None
    record: Path | None

    def refuse_unwritable(self) -> None:
        """End the program where one cannot be written, before any work is done."""
        refuse_unwritable(self.picture, ".png")
        refuse_unwritable(self.video, ".mp4", ".gif")
        refuse_unwritable(self.trace, ".csv", ".parquet")
        refuse_unwritable(self.record, ".rec")

    def any(self) -> bool:
        """Whether there is something to write."""
        return bool(self.picture or self.video or self.trace or self.record)

    @procedures_talk()
    def write(self, session: RunSession, run: RecordedRun, setup: RunSetup, found: dict[str, Any]) -> None:
        """Write what was asked for of a run of the setup, and say so."""
        if self.picture:
            _draw(session, run, found, self.picture)
        if self.video:
            _film(session, run, found, self.video, self.speed)
        if self.trace:
            _tabulate(session, run, self.trace)
        if self.record:
            _record(session, run, setup, found["seed"], self.record)


def _draw(session: RunSession, run: RecordedRun, found: dict[str, Any], path: Path) -> None:
    from mindlang.pictures.picture import png

    if run.task.scene.environment:
        from mindlang.pictures.environments import environment_picture as picture

        what = "the run as its environment draws it"
    else:
        from mindlang.pictures.picture import picture

        what = "the path of the robot"
    try:
        drawn = picture(run, found)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    write_file(path, png(drawn))
    session.say(f"{path}: {what}")


def _film(session: RunSession, run: RecordedRun, found: dict[str, Any], path: Path, speed: float | None) -> None:
    from mindlang.pictures.film import Film

    film = Film(run, found, speed, path.suffix.lower())
    try:
        with session.progress() as progress:
            bar = progress.add_task(path.name, total=len(film))
            film.write(path, lambda: progress.advance(bar))
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}", code=MISUSE)
    session.say(f"{path}: {film.seconds:.0f} s at {film.speed:g} times the robot's speed")


def _tabulate(session: RunSession, run: RecordedRun, path: Path) -> None:
    from mindlang.run.trace_file import trace_bytes

    try:
        data = trace_bytes(run, path.suffix.lower())
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    write_file(path, data)
    session.say(f"{path}: a row for each of {in_words(run.ticks)}")


def _record(session: RunSession, run: RecordedRun, setup: RunSetup, seed: int, path: Path) -> None:
    from mindlang.run.run_recording import run_bytes

    try:
        data = run_bytes(run, setup, seed)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    write_file(path, data)
    session.say(f"{path}: {in_words(run.ticks)}, to be seen with its source or a bundle of it that has no robot")
