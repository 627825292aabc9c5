"""Several files changed together or not at all, whatever happens meanwhile.

Before anything is written, a journal beside them keeps what they were; it goes when all is done. A journal that is
found later is of a change that was interrupted: the files are put back.
"""

import fcntl
import json
import os
from base64 import b64decode, b64encode
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from mindrun.durable import sync_folder, write
from mindrun.errors import MindError

NAME = ".mind-edit"


class JournalError(MindError):
    """Files that cannot be written, or put back."""


def change(folder: Path, files: Mapping[Path, bytes]) -> None:
    """Write files, all of them in `folder` or below; JournalError where that fails.

    Whether this ends, fails or is killed: afterwards, at the latest when `recover` has been called, either all files
    are changed or all are as they were.
    """
    with _alone(folder):
        _put_back(folder)
        try:
            write(folder / NAME, _journal(folder, files))
            for path, data in files.items():
                path.parent.mkdir(parents=True, exist_ok=True)
                _set(path, data)
        except OSError as error:
            _put_back(folder)
            raise JournalError(f"{error.filename or folder} cannot be written: {error.strerror}") from error
        _done(folder)


def recover(folder: Path) -> bool:
    """Put back what an interrupted change left behind in a folder or above it; whether there was one.

    JournalError where that would lose work that was done since.
    """
    left = [above for above in (folder, *folder.parents) if (above / NAME).exists()]
    return any([_recovered(above) for above in left])


def _recovered(folder: Path) -> bool:
    with _alone(folder):  # not while that change is still going on
        return _put_back(folder)


def _journal(folder: Path, files: Mapping[Path, bytes]) -> bytes:
    """What the files are, and a hash of what they are going to be."""
    plain = {
        path.relative_to(folder).as_posix(): {"was": _packed(_get(path)), "becomes": _hash(data)}
        for path, data in files.items()
    }
    return json.dumps(plain).encode()


def _put_back(folder: Path) -> bool:
    try:
        plain = json.loads((folder / NAME).read_bytes())
    except FileNotFoundError:
        return False
    old = {folder / path: (_unpacked(told["was"]), told["becomes"]) for path, told in plain.items()}
    for path, (was, becomes) in old.items():
        now = _get(path)
        if now != was and _hash(now) != becomes:
            raise JournalError(
                f"{path} has been changed since an edit was interrupted",
                f"keep the files as they are by deleting {folder / NAME}, or get {path.name} back",
            )
    for path, (was, _) in old.items():
        _set(path, was)
    _done(folder)
    return True


def _done(folder: Path) -> None:
    (folder / NAME).unlink()
    sync_folder(folder)


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let one process at a time change files of a folder."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _get(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        return None


def _set(path: Path, data: bytes | None) -> None:
    if data is None:
        path.unlink(missing_ok=True)
    elif _get(path) != data:
        write(path, data)


def _hash(data: bytes | None) -> str:
    return "" if data is None else sha256(data).hexdigest()


def _packed(data: bytes | None) -> str | None:
    return None if data is None else b64encode(data).decode()


def _unpacked(text: str | None) -> bytes | None:
    return None if text is None else b64decode(text)
