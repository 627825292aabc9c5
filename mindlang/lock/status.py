"""Which skills of a mind have weights that fit, what is different about those that do not, and keeping new ones."""

import fcntl
import os
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import numpy as np
from mindrun.durable import write
from mindrun.errors import WeightsError
from mindrun.functions import Mlp
from mindrun.graph import Graph, Skill
from mindrun.weights import from_npy, genes, reachable, to_npy, weights_of
from numpy.typing import NDArray

from mindlang.lock import Entry, Lock, LockError, Taught, read_lock, write_lock
from mindlang.lock.signature import differences, signature

Weights = NDArray[np.float32]
FOLDER = "weights"


@dataclass(frozen=True, slots=True)
class Trained:
    """Its weights fit. The notes say which subskills are others than those that it was taught with."""

    entry: Entry
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Stale:
    """Its weights belong to another declaration; each difference is a sentence."""

    differences: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Untaught:
    """It learns, and has no weights yet."""


@dataclass(frozen=True, slots=True)
class NotLearning:
    """It has no weights to learn."""


Status = Trained | Stale | Untaught | NotLearning


def status(graph: Graph, lock: Lock) -> dict[str, Status]:
    """How each skill of a mind stands to its lock; reads no weights."""
    return {skill.name: _status(graph, skill, lock) for skill in graph.skills}


def _status(graph: Graph, skill: Skill, lock: Lock) -> Status:
    if genes(skill) == 0:
        return NotLearning()
    entry = lock.get(skill.name)
    if entry is None:
        return Untaught()
    found = differences(entry.signature, signature(graph, skill), _width_is_derived(skill))
    return Stale(found) if found else Trained(entry, tuple(_notes(entry, lock)))


def _width_is_derived(skill: Skill) -> bool:
    return isinstance(skill.function, Mlp) and skill.function.width == 0


def _notes(entry: Entry, lock: Lock) -> Iterator[str]:
    for skill, weights in entry.subskills:
        now = lock.get(skill)
        if now is None:
            yield f"taught with a {skill} ({weights[:4]}…) that has no weights now"
        elif now.weights != weights:
            yield f"taught with another {skill} ({weights[:4]}…, now {now.weights[:4]}…)"


def trained_weights(graph: Graph, lock: Lock, skills: Collection[str]) -> tuple[dict[str, Weights], list[str]]:
    """The weights of those of `skills` that learn, and a message for each that has none or stale ones.

    The graph must be `arrange`d. LockError where a file of weights is damaged.
    """
    weights: dict[str, Weights] = {}
    refusals = []
    for name, state in status(graph, lock).items():
        if name not in skills:
            continue
        match state:
            case Trained(entry):
                skill = next(skill for skill in graph.skills if skill.name == name)
                weights[name] = load_weights(entry, skill)
            case Stale(found):
                refusals.append(f"the weights of {name} are stale: {'; '.join(found)}")
            case Untaught():
                refusals.append(f"{name} has not been taught")
    return weights, refusals


def load_weights(entry: Entry, skill: Skill) -> Weights:
    """The weights of an entry, held against its hash and its skill; LockError where they are not those."""
    path = _blob(entry.folder, entry.weights)
    try:
        if not path.resolve().is_relative_to(entry.folder.resolve()):
            raise LockError(f"{path} leads out of {entry.folder}")
        data = path.read_bytes()
        if sha256(data).hexdigest() != entry.weights:
            raise LockError(f"{path}, the weights of {entry.skill}, is damaged: get it back, or train {entry.skill}")
        return weights_of(skill, {skill.name: from_npy(data)})
    except OSError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, cannot be read: {error.strerror}") from error
    except WeightsError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, do not fit: {error}") from error


def record(
    path: Path, graph: Graph, skill: str, weights: Weights, taught: Taught, others: Mapping[str, Weights]
) -> Entry:
    """Keep what a lesson taught: the weights as a file, the skill's line in the lock at `path`; the other lines stay.

    `others` are the weights of the skills that it was taught with. A file of the skill's old weights goes when no lock
    of the folder names it.
    """
    below = reachable(graph, skill)
    subskills = tuple(sorted((sub.name, digest(others[sub.name])) for sub in below[1:] if sub.name in others))
    entry = Entry(skill, signature(graph, below[0]), digest(weights), taught, subskills, path.parent)
    try:
        with _alone(path.parent / FOLDER):
            lock = read_lock(path)
            write(_blob(path.parent, entry.weights), to_npy(weights))
            write_lock(path, lock | {skill: entry})
            if skill in lock:
                _forget(path.parent, lock[skill].weights)
    except OSError as error:
        raise LockError(f"the weights of {skill} cannot be written: {error.strerror} ({error.filename})") from error
    return entry


def digest(weights: Weights) -> str:
    """The SHA-256 of weights as they lie in their file."""
    return sha256(to_npy(weights)).hexdigest()


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let one process at a time change a folder of weights and the locks beside it."""
    folder.mkdir(exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _blob(folder: Path, weights: str) -> Path:
    return folder / FOLDER / f"{weights}.npy"


def _forget(folder: Path, weights: str) -> None:
    """Remove old weights, unless a skill has them still: the locks of one folder share their weights."""
    if not any(f"| weights {weights}".encode() in lock.read_bytes() for lock in folder.glob("*.lock")):
        _blob(folder, weights).unlink(missing_ok=True)
