"""Files of weights that no lock names any more: `mindc gc` alone removes them."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

from mindrun.files.regular_files import read_regular

from mindlang.lock import LockError, read_lock
from mindlang.lock.blobs import FOLDER, exclusive_folder

_BLOB = re.compile(r"(?P<hash>[0-9a-f]{64})\.npy")


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
    named = {
        entry.weights for lock in folder.glob("*.lock") if is_of_a_mind(lock) for entry in read_lock(lock).values()
    }
    blobs = ((path, _BLOB.fullmatch(path.name)) for path in sorted((folder / FOLDER).iterdir()))
    return [path for path, found in blobs if found and found["hash"] not in named and not path.is_symlink()]


def is_of_a_mind(lock: Path) -> bool:
    """Whether a lock is one of ours: other tools have locks, too (poetry.lock)."""
    return lock.with_suffix(".mind").exists() or read_regular(lock, 11) == b"# mind lock"
