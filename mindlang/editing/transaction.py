"""Several files changed together or not at all, and the last edit that was written so taken back.

Before an edit is written, a note beside its files says what they were. What fails is put back at once; of an edit
whose process was killed while it wrote, the note is there, and `mindc edit undo` takes it back.
"""

import errno
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from hashlib import sha256
from pathlib import Path

import msgspec
from mindrun.errors import MindError
from mindrun.files.atomic_write import exchange, exclusive_access, write
from mindrun.files.regular_files import read_whole

from mindlang.lock.blobs import FOLDER, exclusive_folder

UNDO_NAME = ".mind-undo"  # the note of the last edit
MAX_FILE_BYTES = 1 << 28  # of a file that is changed, and of a note
CHANGED_SUFFIXES = (".mind", ".lock", ".npy")  # of files that mindc changes

Files = Mapping[Path, bytes | None]  # None for one that is not there


class TransactionError(MindError):
    """Files that cannot be written, or put back."""


class _Noted(msgspec.Struct, frozen=True):
    """The contents of a file before an edit, and the hash of those after it; None and "" where there is no file."""

    was: bytes | None
    becomes: str


def change(folder: Path, files: Files, check: Callable[[], None] = lambda: None, keeps: bool = False) -> None:
    """Write files, all of them in `folder` or below, None for one that goes; TransactionError where that fails.

    Then all are as they were, but for what somebody else has written meanwhile. `check` may still refuse, when no
    other process can change these files. What they were is kept for `undo` where that is wished for.
    """
    for path in files:
        if not _is_ours(folder, path):
            kinds = ", ".join(CHANGED_SUFFIXES[:-1]) + f" and {CHANGED_SUFFIXES[-1]}"
            raise TransactionError(f"{path} cannot be changed together with others: it is a link, or none of {kinds}")
    with exclusive_access(folder):
        check()
        note = folder / UNDO_NAME
        try:
            were = {path: _get(path) for path in (note, *files)}
            noted = {path.relative_to(folder).as_posix(): _Noted(were[path], _hash(files[path])) for path in files}
            writing = {note: msgspec.json.encode(noted), **files} if keeps else {**files}
            try:
                for path, data in writing.items():
                    if data != were[path]:
                        _exchange(path, data, were[path])
            except BaseException:
                _put_back(writing, were)
                raise
        except OSError as error:
            raise TransactionError(f"{error.filename or folder} cannot be written: {error.strerror}") from error


@contextmanager
def no_training(files: Iterable[Path]) -> Iterator[None]:
    """Let no training write what it has taught into those of these files that are locks."""
    with ExitStack() as stack:
        for weights in sorted({path.parent / FOLDER for path in files if path.suffix == ".lock"}):
            stack.enter_context(exclusive_folder(weights))
        yield


def common_folder(files: Iterable[Path]) -> Path:
    """The folder in which all files lie, or below."""
    return Path(os.path.commonpath([path.parent for path in files]))


def noted_in(folder: Path) -> Path | None:
    """The folder, or the nearest above it, in which an edit was written last; None where none was."""
    return next((each for each in (folder, *folder.parents) if (each / UNDO_NAME).is_file()), None)


def undo(folder: Path) -> tuple[Files, Files]:
    """Take back the last edit that was written in a folder; returns its files as they were until now, and as they are.

    What was done before that edit is not kept. TransactionError where a file has been changed since.
    """
    files = _before(folder)
    now = {path: _get(path) for path in files}

    def refuse_changed() -> None:
        if _before(folder) != files:
            raise TransactionError("another edit has been written meanwhile", "nothing has been taken back")

    with no_training(files):
        change(folder, files, refuse_changed)
    (folder / UNDO_NAME).unlink(missing_ok=True)
    return now, files


def _before(folder: Path) -> Files:
    """The files of the last edit as they were before it; TransactionError where one has been changed since."""
    note = folder / UNDO_NAME
    try:
        noted = msgspec.json.decode(read_whole(note, MAX_FILE_BYTES), type=dict[str, _Noted])
        files = {folder / name: each for name, each in noted.items()}
        is_ours = all(_is_ours(folder, path) for path in files)  # it may have come with a project that was fetched
    except OSError as error:
        raise TransactionError(f"{note} cannot be read: {error.strerror}", "delete it") from error
    except (msgspec.MsgspecError, ValueError, RuntimeError):  # what nests too deep, or links in a circle
        is_ours = False
    if not is_ours:
        raise TransactionError(f"{note} is not what mindc wrote", "delete it")
    for path, each in files.items():
        if _hash(_get(path)) not in (each.becomes, _hash(each.was)):
            message = f"{path} has been changed since the last edit was written"
            raise TransactionError(message, "nothing has been taken back")
    return {path: each.was for path, each in files.items()}


def _put_back(files: dict[Path, bytes | None], were: Files) -> None:
    """Undo at once what a change has written before it failed; what somebody else has written stays."""
    try:
        for path, data in reversed(files.items()):  # the note last: where this fails, too, it is needed
            if data == were[path] or _get(path) != data:
                continue
            if (was := were[path]) is None:
                path.unlink(missing_ok=True)
            else:
                write(path, was)
    except OSError as error:
        message = f"{error.filename} cannot be written: {error.strerror}"
        raise TransactionError(message, "the edit is half done: mindc edit undo takes it back") from error


def _exchange(path: Path, data: bytes | None, was: bytes | None) -> None:
    """Write or remove a file, unless somebody has written it since it `was` read."""
    if data is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        exchange(path, data, was)
    elif _get(path) == was:
        path.unlink()
    else:
        raise OSError(errno.ESTALE, "it has been changed meanwhile", str(path))


def _is_ours(folder: Path, path: Path) -> bool:
    """True if a path leads into the folder, to a file of a kind that mindc changes."""
    return path.suffix in CHANGED_SUFFIXES and not path.is_symlink() and path.resolve().is_relative_to(folder.resolve())


def _get(path: Path) -> bytes | None:
    try:
        return read_whole(path, MAX_FILE_BYTES)
    except FileNotFoundError:
        return None


def _hash(data: bytes | None) -> str:
    return "" if data is None else sha256(data).hexdigest()
