"""How `mindc weights import` goes and what it says."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from mindrun.errors import MindError
from mindrun.terminal.tick_count import ticks as in_words
from mindrun.train import NotFoundError

from mindlang.cli._simulator_compilation import ensure_compiled
from mindlang.cli._terminal import FINDINGS, MISUSE, OK, fail, print_json, procedures_talk, talk
from mindlang.number_format import number
from mindlang.training.lock_update import COMPARED_LAYOUTS
from mindlang.training.subject import Subject
from mindlang.weights.importing import Imported, import_weights, open_trial


def import_file(
    subject: Subject, skill: str, path: Path, recording: str | None, force: bool, as_json: bool, quiet: bool
) -> None:
    """Import the weights of a file, print what came of them, and end the program."""

    def say(line: str) -> None:
        if not quiet:
            talk.print(line, markup=False)

    try:
        with procedures_talk():
            trial = open_trial(subject, skill, path)
            ensure_compiled(trial.rollout, say)
            found = import_weights(trial, recording, force)
    except NotFoundError as error:
        fail(f"{error}.", error.hint, MISUSE)
    except MindError as error:
        fail(f"{error}.", error.hint)
    for line in _lines(found, subject.keep_path(trial.lesson).name, recording):
        say(line)
    if as_json:
        print_json(found.data())
    sys.exit(OK if found.is_kept else FINDINGS)


def _lines(found: Imported, lock: str, recording: str | None) -> Iterator[str]:
    trial, compared = found.trial, found.deviation
    skill, lesson = trial.network.skill.name, trial.lesson
    where = recording or f"a run of {lesson.task}"
    yield (
        f"{trial.path}: {len(trial.genome):,} weights of {skill}; "
        f"{compared.reference} and the engine differ by at most {compared.difference:.3g} "
        f"in {in_words(compared.ticks)} of {where}"
    )
    if compared.faults:
        yield f"{compared.faults:,} outputs were not finite, and are not sent"
    if compared.reference == "float64":
        yield "PyTorch is not installed: pip install 'mindlang[torch]' compares with the function there"
    yield f"{skill} scores {number(found.score)} on {COMPARED_LAYOUTS} fresh layouts of {lesson.task}"
    if found.is_unchanged:
        yield f"{lock} has these weights already, and stays as it is"
    elif not found.is_kept:
        yield f"{found.scores}, and stay in {lock}; --force takes the new ones all the same"
    else:
        worse = f"; but {found.scores}" if found.scores and found.scores.is_worse else ""
        yield f"weights in {lock}{worse}"
    yield from found.notes
