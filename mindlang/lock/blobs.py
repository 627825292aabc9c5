"""Files of weights beside a lock: read and held against it, and new ones kept."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from mindrun import durable
from mindrun.durable import write
from mindrun.errors import WeightsError
from mindrun.graph import Graph, Skill
from mindrun.weights import Weights, from_npy, reachable, to_npy, weights_of

from mindlang.diagnostic import listed
from mindlang.lock import Entry, LockError, Taught, read_lock, write_lock
from mindlang.lock.signature import signature

FOLDER = "weights"


def load_weights(entry: Entry, skill: Skill) -> Weights:
    """The weights of an entry, held against its hash and its skill; LockError where they are not those."""
    path = blob(entry.folder, entry.weights)
    remedy = f"get it back, or train {entry.skill} --from-scratch"
    try:
        if not path.resolve().is_relative_to(entry.folder.resolve()):
            raise LockError(f"{path} leads out of {entry.folder}")
        data = path.read_bytes()
        if sha256(data).hexdigest() != entry.weights:
            raise LockError(f"{path}, the weights of {entry.skill}, is damaged: {remedy}")
        return weights_of(skill, {skill.name: from_npy(data)})
    except OSError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, cannot be read: {error.strerror}; {remedy}") from error
    except WeightsError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, do not fit: {error}") from error


def record(
    path: Path, graph: Graph, learnt: Mapping[str, Weights], taught: Taught, others: Mapping[str, Weights]
) -> dict[str, Entry]:
    """Keep what a lesson taught: weights as files, the skills' lines in the lock at `path`; the other lines stay.

    `others` are the weights of the skills that they were taught with. A file of a skill's old weights goes when no lock
    of the folder names it.
    """
    entries = {skill: _entry(path, graph, skill, {**others, **learnt}, taught) for skill in learnt}
    try:
        with alone(path.parent / FOLDER):
            lock = read_lock(path)
            for skill, entry in entries.items():
                write(blob(path.parent, entry.weights), to_npy(learnt[skill]))
            write_lock(path, lock | entries)
            for skill in entries.keys() & lock.keys():
                _forget(path.parent, lock[skill].weights)
    except OSError as error:
        names = listed(entries, "and")
        raise LockError(f"the weights of {names} cannot be written: {error.strerror}") from error
    return entries


def _entry(path: Path, graph: Graph, skill: str, weights: Mapping[str, Weights], taught: Taught) -> Entry:
    below = reachable(graph, skill)
    subskills = tuple(sorted((sub.name, digest(weights[sub.name])) for sub in below[1:] if sub.name in weights))
    return Entry(skill, signature(graph, below[0]), digest(weights[skill]), taught, subskills, path.parent)


def digest(weights: Weights) -> str:
    """The SHA-256 of weights as they lie in their file."""
    return sha256(to_npy(weights)).hexdigest()


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Let one process at a time change a folder of weights and the locks beside it."""
    folder.mkdir(exist_ok=True)
    with durable.alone(folder):
        yield


def blob(folder: Path, weights: str) -> Path:
    """The file of weights of this SHA-256, for the locks of a folder."""
    return folder / FOLDER / f"{weights}.npy"


def _forget(folder: Path, weights: str) -> None:
    """Remove old weights, unless a skill has them still: the locks of one folder share their weights."""
    if not any(f"| weights {weights}".encode() in lock.read_bytes() for lock in folder.glob("*.lock")):
        blob(folder, weights).unlink(missing_ok=True)
