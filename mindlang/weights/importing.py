"""Weights from a file: held against the engine, tried in their lesson, and written into the lock if they do well."""

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.weights import Weights, learners
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError

from mindlang.lock import FILE_ORIGIN, LockError, Taught, read_lock, read_locks
from mindlang.lock.blobs import Origin, digest, record
from mindlang.lock.ready import elsewhere_sentences
from mindlang.lock.status import status, trained_weights
from mindlang.lock.world_facts import Worlds
from mindlang.training.lesson_choice import chosen_lessons
from mindlang.training.lock_update import Comparison
from mindlang.training.subject import Subject
from mindlang.weights.comparison import Deviation, compare
from mindlang.weights.files import genome_in, read_bytes
from mindlang.weights.network import Network, network_of
from mindlang.weights.trial import Trial


@dataclass(frozen=True, slots=True)
class Incoming:
    """Weights in a file that fit a skill, and the lesson in which they will be tried."""

    path: Path
    network: Network
    lesson: Lesson
    genome: Weights
    file_digest: str

    @property
    def origin(self) -> Origin:
        """Where they come from, as a lock says it."""
        return f"{FILE_ORIGIN}{quote(self.path.name, safe='')}", self.file_digest


@dataclass(frozen=True, slots=True)
class Imported:
    """The outcome of an import: the engine's deviation, the scores, and whether the lock has the weights now.

    `scores` has the old ones beside them, where there were any that fit. `notes` say which skills were taught with
    those that were there. The lock `is_unchanged` where it had these very weights.
    """

    incoming: Incoming
    deviation: Deviation
    score: float
    scores: Comparison | None
    is_kept: bool
    is_unchanged: bool = False
    notes: tuple[str, ...] = ()

    def data(self) -> dict[str, Any]:
        """The file, the deviation and the scores as plain data for JSON."""
        incoming, compared = self.incoming, self.deviation
        return {
            "skill": incoming.network.skill.name,
            "file": str(incoming.path),
            "file_sha256": incoming.file_digest,
            "weights": digest(incoming.genome),
            "kept": self.is_kept,
            "reference": compared.reference,
            "ticks": compared.ticks,
            "difference": compared.difference,
            "faults": compared.faults,
            "task": incoming.lesson.task,
            "master": incoming.lesson.master,
            "score": self.score,
            "score_before": None if self.scores is None else self.scores.old,
            "notes": [*self.notes],
        }


def read_incoming(subject: Subject, skill: str, path: Path) -> Incoming:
    """The weights of a skill in a file; MindError where they are not, and where nothing would come of them."""
    network = network_of(subject.graph, skill)
    lesson = chosen_lessons(subject.graph, None, [skill])[-1]
    if skill not in learners(subject.graph, lesson):
        raise RunError(f"{skill} is frozen", command_line("mindc", "edit", "unfreeze", subject.shown, skill, "--write"))
    data = read_bytes(path)
    return Incoming(path, network, lesson, genome_in(path, data, network), sha256(data).hexdigest())


def import_weights(trial: Trial, incoming: Incoming, recording: str | None, force: bool) -> Imported:
    """Compare and try weights, and write them into the lock, unless what is there does better; with `force` even then.

    LockError where the lock cannot be read or written.
    """
    subject, genome = trial.subject, incoming.genome
    rows = trial.recorded(recording) if recording else trial.readings(genome)
    compared = compare(incoming.network, genome, rows)
    old = _weights_there(subject, incoming)
    if old is not None and np.array_equal(old, genome):
        score, scores = trial.score(genome, None)
        return Imported(incoming, compared, score, scores, True, True)
    score, scores = trial.score(genome, old)
    if scores and scores.is_worse and not force:
        return Imported(incoming, compared, score, scores, False)
    return Imported(incoming, compared, score, scores, True, notes=_write(trial, incoming, score))


def _weights_there(subject: Subject, incoming: Incoming) -> Weights | None:
    """The weights in the lock to which the new ones go; None where there are none that fit, or they are damaged."""
    name = incoming.network.skill.name
    try:
        lock = read_lock(subject.keep_path(incoming.lesson))
        return trained_weights(subject.graph, lock, [name])[0].get(name)
    except LockError:
        return None


def _write(trial: Trial, incoming: Incoming, score: float) -> tuple[str, ...]:
    """Write the line of the skill; a sentence for each skill that was taught with what was there before."""
    subject, lesson, name = trial.subject, incoming.lesson, incoming.network.skill.name
    reached = score, lesson.number, lesson.curriculum, trial.success(incoming.genome)
    taught = Taught(lesson.task, lesson.master, False, 0, 0, 0, *reached)
    record(
        subject.keep_path(lesson),
        subject.graph,
        {name: incoming.genome},
        taught,
        trial.others,
        Worlds(subject.graph, subject.folder).of(lesson),
        origins={name: incoming.origin},
        accepted=True,
    )
    before = status(subject.graph, subject.lock, subject.folder)
    now = status(subject.graph, read_locks(subject.taught), subject.folder)
    changed = {skill: state for skill, state in now.items() if state != before[skill]}
    return (*elsewhere_sentences(changed),)
