"""Several files changed together or not at all, whatever happens meanwhile.

Before anything is written, a journal beside them keeps what they were; when all is done it goes, or is kept under
another name so that the change can be taken back. A journal that is found later is of a change that was interrupted:
the files are put back.
"""

import errno
import json
import os
from base64 import b64decode, b64encode
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from stat import S_ISREG

from mindrun.errors import MindError
from mindrun.files.atomic_write import exchange, exclusive_access, spare, sync_folder, write
from mindrun.files.regular_files import read_whole

JOURNAL_NAME = ".mind-edit"
UNDO_NAME = ".mind-undo"  # the journal of the last change that may be taken back
MAX_FILE_BYTES = 1 << 28  # of a file that is changed, and of a journal
CHANGED_SUFFIXES = (".mind", ".lock", ".npy")  # of files that mindc changes


class TransactionError(MindError):
    """Files that cannot be written, or put back."""


@dataclass(frozen=True, slots=True)
class _Noted:
    """What a file was, and a hash of what it is going to be; None and "" where there is none."""

    was: bytes | None
    becomes: str


def change(
    folder: Path, files: Mapping[Path, bytes | None], check: Callable[[], None] = lambda: None, keeps: bool = False
) -> None:
    """Write files, all of them in `folder` or below, None for one that goes; TransactionError where that fails.

    Whether this ends, fails or is killed: afterwards, at the latest when `recover` has been called, either all files
    are changed or all are as they were. `check` may still refuse, when no other process can change these files. What
    they were is kept for `last_change` where that is wished for.
    """
    for path in files:
        if not _is_ours(folder, path):
            kinds = ", ".join(CHANGED_SUFFIXES[:-1]) + f" and {CHANGED_SUFFIXES[-1]}"
            raise TransactionError(f"{path} cannot be changed together with others: it is a link, or none of {kinds}")
    waiting = set[Path]()
    with exclusive_access(folder):
        try:
            _put_back(folder)
            check()
            were = {path: _get(path) for path in files}
            write(folder / JOURNAL_NAME, _journal(folder, files, were))
            waiting.update(files)
            for path, data in files.items():
                _change(path, data, were[path])
                waiting.remove(path)
            _done(folder, keeps)
        except BaseException as error:
            _undo(folder, waiting)
            if isinstance(error, OSError):
                raise TransactionError(f"{error.filename or folder} cannot be written: {error.strerror}") from error
            raise


def last_change(folder: Path) -> dict[Path, bytes | None]:
    """What the files of the last change that was kept in a folder were before it, None those that it made.

    Empty where none was kept; TransactionError where it is not to be read, or a file is not what that change made it.
    """
    noted = _read(folder / UNDO_NAME) or {}
    for path, note in noted.items():
        if _hash(_get(path)) != note.becomes:
            raise TransactionError(
                f"{path} has been changed since the last edit was written", "nothing has been taken back"
            )
    return {path: note.was for path, note in noted.items()}


def recover(folder: Path) -> bool:
    """Put back what an interrupted change left behind in a folder or above it; whether there was one.

    TransactionError where that would lose work that was done since.
    """
    return sum(_recovered(above) for above in (folder, *folder.parents) if _is_left(above / JOURNAL_NAME)) > 0


def _is_left(journal: Path) -> bool:
    """Whether a journal lies there; one of somebody else does not count, nor what is no file."""
    try:
        found = journal.lstat()
    except OSError:
        return False
    return S_ISREG(found.st_mode) and found.st_uid == os.getuid()


def _recovered(folder: Path) -> bool:
    with exclusive_access(folder):  # not while that change is still going on
        return _put_back(folder)


def _undo(folder: Path, waiting: Collection[Path]) -> None:
    """Put back at once what a failed change has written; where that fails too, the journal stays."""
    if not _is_left(folder / JOURNAL_NAME):  # nothing had been written yet
        with suppress(OSError):
            spare(folder / JOURNAL_NAME).unlink(missing_ok=True)
        return
    try:
        _put_back(folder, waiting)
    except OSError as error:
        raise TransactionError(
            f"{error.filename or folder} cannot be written: {error.strerror}",
            f"the edit is half done; any mindc command takes it back as soon as {folder} can be written again",
        ) from error


def _journal(folder: Path, files: Mapping[Path, bytes | None], were: Mapping[Path, bytes | None]) -> bytes:
    plain = {
        path.relative_to(folder).as_posix(): {"was": _packed(were[path]), "becomes": _hash(data)}
        for path, data in files.items()
    }
    return json.dumps(plain).encode()


def _put_back(folder: Path, waiting: Collection[Path] = ()) -> bool:
    """Put back what a journal says, if there is one; of the `waiting` files what somebody else has written stays."""
    spare(folder / JOURNAL_NAME).unlink(missing_ok=True)
    if (noted := _read(folder / JOURNAL_NAME)) is None:
        return False
    names = ", ".join(path.name for path in noted if path.suffix != ".npy")
    for path, note in noted.items():
        now = _get(path)
        if now != note.was and _hash(now) != note.becomes and path not in waiting:
            raise TransactionError(
                f"{path} has been changed since an edit of {names} was interrupted",
                f"keep them as they are by deleting {folder / JOURNAL_NAME}, or get {path.name} back",
            )
    for path, note in noted.items():
        spare(path).unlink(missing_ok=True)
        if _hash(_get(path)) == note.becomes:
            _set(path, note.was)
    _done(folder)
    return True


def _read(journal: Path) -> dict[Path, _Noted] | None:
    """What a journal says, if there is one; TransactionError where it is none that mindc wrote."""
    if not _is_left(journal):
        return None
    try:
        plain = json.loads(_get(journal) or b"")
        return {
            _inside(journal.parent, path): _Noted(_unpacked(told["was"]), str(told["becomes"]))
            for path, told in plain.items()
        }
    except OSError as error:
        raise TransactionError(f"{journal} cannot be read: {error.strerror}", "delete it") from error
    except (ValueError, TypeError, KeyError, AttributeError, RuntimeError) as error:
        # a RuntimeError is of what nests too deep, or of links in a circle
        raise TransactionError(f"{journal} is not what mindc wrote", "delete it") from error


def _inside(folder: Path, name: str) -> Path:
    """The path of a file in a folder; ValueError where that leads out of it, or to a file that mindc never changes.

    A journal may have come from anywhere, with a project that somebody has fetched.
    """
    path = folder / name
    if not _is_ours(folder, path):
        raise ValueError(name)
    return path


def _is_ours(folder: Path, path: Path) -> bool:
    return path.suffix in CHANGED_SUFFIXES and not path.is_symlink() and path.resolve().is_relative_to(folder.resolve())


def _done(folder: Path, keeps: bool = False) -> None:
    journal = folder / JOURNAL_NAME
    if keeps:
        journal.replace(folder / UNDO_NAME)
    else:
        journal.unlink()
    with suppress(OSError):  # at worst a power cut brings the journal back, and all is as it was
        sync_folder(folder)


def _get(path: Path) -> bytes | None:
    try:
        return read_whole(path, MAX_FILE_BYTES)
    except FileNotFoundError:
        return None


def _change(path: Path, data: bytes | None, was: bytes | None) -> None:
    """Write or remove a file, unless somebody has written it since it `was` read."""
    if data == was:
        return
    if data is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        exchange(path, data, was)
    elif _get(path) == was:
        path.unlink()
    else:
        raise OSError(errno.ESTALE, "it has been changed meanwhile", str(path))


def _set(path: Path, data: bytes | None) -> None:
    if data is None:
        path.unlink(missing_ok=True)
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        write(path, data)


def _hash(data: bytes | None) -> str:
    return "" if data is None else sha256(data).hexdigest()


def _packed(data: bytes | None) -> str | None:
    return None if data is None else b64encode(data).decode()


def _unpacked(text: str | None) -> bytes | None:
    return None if text is None else b64decode(text, validate=True)
