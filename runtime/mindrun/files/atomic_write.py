"""Files written so that a crash at any moment leaves either the old one or the new one.

Nothing but a regular file is ever replaced. Its mode stays; where it has other names, hard links, those keep what it
was, and it belongs to who has written it last.
"""

import errno
import fcntl
import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from mindrun.files.regular_files import irregular, read_regular

Data = bytes | Iterable[bytes]  # what is written: all of it, or part after part


def write(path: Path, data: Data) -> None:
    """Replace `path`, or a link that stands there, by `data`, on the disk before this returns.

    An OSError leaves the old file as it was.
    """
    write_beside(path, data).replace(path)
    sync_folder(path.parent)


def write_out(path: Path, data: Data) -> None:
    """Write to a path that a user has named: a link is followed. OSError where no file can be written there."""
    write(destination(path), data)


def rewrite(path: Path, data: bytes, was: bytes) -> None:
    """Write a file anew that has been read as `was`; OSError, too, where somebody has written it since."""
    path = destination(path)
    with exclusive_access(path.parent):
        exchange(path, data, was)


def exchange(path: Path, data: bytes, was: bytes | None) -> None:
    """Replace a file if it still is what it `was`, None for none; the caller holds `exclusive_access` of its folder.

    OSError where somebody has written it since, and where it is a link.
    """
    beside = write_beside(path, data)
    try:
        try:
            now = read_regular(path, len(was or b"") + 1)  # looked at as late as can be
        except FileNotFoundError:
            now = None
        if now != was:
            raise OSError(errno.ESTALE, "it has been changed meanwhile", str(path))
        beside.replace(path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
    sync_folder(path.parent)


def write_beside(path: Path, data: Data) -> Path:
    """Write `data` to a temporary file beside `path`, on the disk and with its mode; the path of the temporary file.

    One process at a time may do that. What a crash leaves there is never read.
    """
    mode = _mode(path)
    beside = path.with_name(f".{path.name}.mind-tmp")
    try:
        beside.unlink(missing_ok=True)
        with beside.open("xb") as file:
            if mode is not None:
                os.fchmod(file.fileno(), mode)
            file.writelines((data,) if isinstance(data, bytes) else data)
            file.flush()
            os.fsync(file.fileno())
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
    return beside


def destination(path: Path) -> Path:
    """Where a path that a user has named leads: to a regular file, or to none yet; OSError where it cannot be one."""
    try:
        place = path.resolve()
    except RuntimeError as error:  # links in a circle, before Python 3.13
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path)) from error
    for folder in (path.parent, place.parent):
        if not folder.is_dir():
            raise OSError(errno.ENOTDIR, f"there is no folder {folder}", str(path))
    _mode(place)
    return place


def refuse(path: Path) -> None:
    """OSError where nothing could be written to a path that a user has named; looked at before any work is done."""
    place = destination(path)
    for needed in (place.parent, place):
        if needed.exists() and not os.access(needed, os.W_OK):
            raise PermissionError(errno.EACCES, "permission denied", str(path))


@contextmanager
def exclusive_access(folder: Path) -> Iterator[None]:
    """Let one process at a time change files of a folder."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def sync_folder(folder: Path) -> None:
    """Bring the names in a folder to the disk, so that a rename survives a power cut."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _mode(path: Path) -> int | None:
    """The mode of the file at a path, or of the one to which a link leads; None where there is none."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(mode):
        raise irregular(path, mode)
    return mode & 0o7777
