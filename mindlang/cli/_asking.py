"""What `mindc why` does: a run, or a recording, thought again; printed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mindlang.attribution.answer import Course, QuestionError, answer, course_of_recording, course_of_run
from mindlang.attribution.report import answer_text
from mindlang.cli._recordings import refusing_recordings
from mindlang.cli._run_session import RunSession
from mindlang.cli._terminal import MISUSE, console, fail, print_json, procedures_talk


@dataclass(frozen=True, slots=True)
class Asked:
    """What the command line asks about, in which ticks, and how many paths are named."""

    what: str
    ticks: tuple[int, int] | None
    paths: int | None
    as_json: bool


def explain_run(
    file: str, task: str | None, seed: int, master: str | None, interrupt: bool, quiet: bool, asked: Asked
) -> None:
    """Run a task, and print who made what is asked about."""
    session = RunSession(quiet)
    setup, rollout = session.prepare(file, task, master, interrupt)
    made = session.record(setup, rollout, seed)
    _answer(course_of_run(made.run, seed), asked)


def explain_recording(recording: str, bundle: str, asked: Asked) -> None:
    """Compute a recording again, and print who made what is asked about."""
    with refusing_recordings():
        course = course_of_recording(Path(recording), Path(bundle))
    _answer(course, asked)


def _answer(course: Course, asked: Asked) -> None:
    try:
        with procedures_talk():
            found = answer(course, asked.what, asked.ticks, asked.paths)
    except QuestionError as error:
        fail(str(error), error.hint, MISUSE)
    if asked.as_json:
        print_json(found)
    else:
        console().print(answer_text(found))
