"""Files of weights beside a lock: read and held against it, new ones kept, and those removed that no lock names."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.errors import WeightsError, system_errors_as
from mindrun.files import atomic_write
from mindrun.files.atomic_write import write
from mindrun.files.npy import to_npy
from mindrun.files.regular_files import read_regular, read_whole
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.skill_sets import owners, reachable

from mindlang.compiler.diagnostic import listed
from mindlang.lock import Entry, Lock, LockError, Taught, read_lock, write_lock
from mindlang.lock.signature import signature
from mindlang.lock.training_world import TrainingWorld

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Weights

FOLDER = "weights"
_BLOB = re.compile(r"(?P<hash>[0-9a-f]{64})\.npy")
MAX_WEIGHTS_BYTES = 1 << 27  # of the weights of a skill; a bundle cannot hold more than half of that
EMPTY_LOCK: Lock = {}
Origin = tuple[str, str]  # a skill, and the SHA-256 of its weights; or file:NAME, and that of the file
NO_ORIGINS: Mapping[str, Origin] = {}
NO_WEIGHTS: Mapping[Path, Weights] = {}


def load_weights(entry: Entry, skill: Skill, fresh: Mapping[Path, Weights] = NO_WEIGHTS) -> Weights:
    """The weights of an entry, held against its hash and its skill; LockError where they are not those.

    Those of a file that is not written yet are `fresh`.
    """
    from mindrun.graph.weights import read_weights, weights_of  # which need numpy

    path = blob(entry.folder, entry.weights)
    remedy = f"get it back, or train {entry.skill} --from-scratch"
    try:
        if path in fresh:
            return weights_of(skill, {skill.owner: fresh[path]})
        if not path.resolve().is_relative_to(entry.folder.resolve()):
            raise LockError(f"{path} leads out of {entry.folder}")
        data = read_whole(path, MAX_WEIGHTS_BYTES)
        if sha256(data).hexdigest() != entry.weights:
            raise LockError(f"{path}, the weights of {entry.skill}, is damaged: {remedy}")
        return weights_of(skill, {skill.owner: read_weights(data)})
    except OSError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, cannot be read: {error.strerror}; {remedy}") from error
    except WeightsError as error:
        raise LockError(f"{path}, the weights of {entry.skill}, do not fit: {error}") from error


def record(
    path: Path,
    graph: Graph,
    learnt: Mapping[str, Weights],
    taught: Taught,
    others: Mapping[str, Weights],
    world: TrainingWorld,
    begun_with: Lock = EMPTY_LOCK,
    origins: Mapping[str, Origin] = NO_ORIGINS,
    accepted: bool = False,
) -> dict[str, Entry]:
    """Keep what a lesson taught: weights as files, the skills' lines in the lock at `path`; the other lines stay.

    `others` are the weights of the skills that they were taught with, `world` is the one in which that was, and
    `begun_with` has the lines of the weights that the lesson began with, `origins` the other skills or the files whose
    weights those were. Where they are `accepted` they were taught elsewhere. No file of weights is removed: that is for
    `mindc gc`.
    """
    hashes = {skill: digest(weights) for skill, weights in {**others, **learnt}.items()}
    entries = {}
    for skill in learnt:
        before, below = begun_with.get(skill), reachable(graph, skill)
        earlier = before.worlds if before else ()  # of the same lesson only the last counts
        worlds = (*(each for each in earlier if each.lesson != world.lesson), world)
        origin = origins.get(skill, before.origin if before else None)
        subskills = sorted((name, hashes[name]) for name in owners(below) if name != skill and name in hashes)
        kept = signature(graph, below[0]), hashes[skill], taught, tuple(subskills), worlds, accepted, origin
        entries[skill] = Entry(skill, *kept, path.parent)
    unwritten = f"the weights of {listed(entries, 'and')} cannot be written"
    with system_errors_as(LockError, unwritten), exclusive_folder(path.parent / FOLDER):
        lock = read_lock(path)
        for skill, entry in entries.items():
            write(blob(path.parent, entry.weights), to_npy(learnt[skill]))
        write_lock(path, lock | entries)
    return entries


def digest(weights: Weights) -> str:
    return sha256(to_npy(weights)).hexdigest()


@contextmanager
def exclusive_folder(folder: Path) -> Iterator[None]:
    """Let one process at a time change a folder of weights and the locks beside it."""
    folder.mkdir(exist_ok=True)
    with atomic_write.exclusive_access(folder):
        yield


def blob(folder: Path, weights: str) -> Path:
    """The file of weights of this SHA-256, for the locks of a folder."""
    return folder / FOLDER / f"{weights}.npy"


def unnamed(project: Path) -> list[Path]:
    """The files of weights in a folder, and below, that no lock beside their folder names.

    LockError where a lock is damaged: nobody knows what it names. Where no lock stands at all nothing is unnamed, since
    it may only be missing.
    """
    return [blob for folder in _folders(project) for blob in _unnamed(folder)]


def remove(blobs: list[Path]) -> None:
    """Remove those of these files that still no lock names; LockError where that fails."""
    for folder in sorted({blob.parent.parent for blob in blobs}):
        try:
            with exclusive_folder(folder / FOLDER):  # a training may be writing a lock
                for blob in sorted(set(_unnamed(folder)) & set(blobs)):
                    blob.unlink()
        except OSError as error:
            raise LockError(f"{error.filename} cannot be removed: {error.strerror}") from error


def _folders(project: Path) -> Iterator[Path]:
    """The folders with locks and weights; links are not followed."""
    for path, folders, files in os.walk(project):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        is_link = (Path(path) / FOLDER).is_symlink()
        if FOLDER in folders and not is_link and any(name.endswith(".lock") for name in files):
            yield Path(path)


def _unnamed(folder: Path) -> list[Path]:
    locks = (  # other tools have some, too (poetry.lock)
        lock
        for lock in folder.glob("*.lock")
        if lock.with_suffix(".mind").exists() or read_regular(lock, 11) == b"# mind lock"
    )
    named = {entry.weights for lock in locks for entry in read_lock(lock).values()}
    blobs = ((path, _BLOB.fullmatch(path.name)) for path in sorted((folder / FOLDER).iterdir()))
    return [path for path, found in blobs if found and found["hash"] not in named and not path.is_symlink()]
