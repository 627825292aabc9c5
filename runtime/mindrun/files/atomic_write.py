"""Writing a file so that a crash at any moment leaves either the old one or the new one.

Nothing but a regular file is ever replaced. Its owner and mode stay; where it has other names, hard links, those keep
what it was.
"""

import errno
import fcntl
import os
import re
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from mindrun.files.regular_files import irregular, read_regular

Data = bytes | Iterable[bytes]  # what is written: all of it, or part after part
# Where Linux has the descriptors of a process. What is behind one has perhaps no path, or one that is not its own.
DESCRIPTORS = re.compile(r"/(?:dev|proc/self)/fd/(\d{1,9})|/dev/std(in|out|err)")


def write(path: Path, data: Data) -> None:
    """Replace `path`, or a link that stands there, by `data`, on the disk before this returns.

    An OSError leaves the old file as it was.
    """
    write_beside(path, data).replace(path)
    sync_folder(path.parent)


def write_out(path: Path, data: Data) -> None:
    """Write to a path that a user has named: a link is followed, and a character device or a pipe is written into.

    So `-o /dev/null` and `-o /dev/stdout` do what they do elsewhere. OSError where it cannot be written.
    """
    if (descriptor := descriptor_of(path)) is not None:
        _write_all(descriptor, data)
    elif _takes_all(path):
        with _opened(path) as descriptor:
            _write_all(descriptor, data)
    else:
        write(destination(path), data)


def rewrite(path: Path, data: bytes, was: bytes) -> None:
    """Write a file anew that has been read as `was`; OSError, too, where somebody has written it since."""
    path = destination(path)
    with exclusive_access(path.parent):
        exchange(path, data, was)


def exchange(path: Path, data: bytes, was: bytes | None) -> None:
    """As `rewrite`, for who is alone in the folder and has followed the links; None where there has been no file."""
    beside = write_beside(path, data)
    try:
        if _start(path, len(was or b"") + 1) != was:  # looked at as late as can be
            raise OSError(errno.ESTALE, "it has been changed meanwhile", str(path))
        beside.replace(path)
    except OSError:
        beside.unlink(missing_ok=True)
        raise
    sync_folder(path.parent)


def write_beside(path: Path, data: Data) -> Path:
    """Write `data` to a temporary file beside `path`, on the disk; its path. One process at a time may do that.

    It belongs to the same people as `path`, and may be read and written by the same.
    """
    old = _old(path)
    beside = spare(path)
    try:
        beside.unlink(missing_ok=True)
        with beside.open("xb") as file:
            if old:
                with suppress(PermissionError):  # only root may give a file away
                    os.fchown(file.fileno(), old.st_uid, old.st_gid)
                os.fchmod(file.fileno(), old.st_mode & 0o7777)
            file.writelines(_parts(data))
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        beside.unlink(missing_ok=True)
        raise
    return beside


def spare(path: Path) -> Path:
    """The temporary file beside `path`; what a crash leaves there is never read."""
    return path.with_name(f".{path.name}.mind-tmp")


def destination(path: Path) -> Path:
    """Where a path that a user has named leads: to a regular file, or to none yet; OSError where it cannot be one."""
    try:
        place = path.resolve()
    except RuntimeError as error:  # links in a circle, before Python 3.13
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path)) from error
    for folder in (path.parent, place.parent):
        if not folder.is_dir():
            raise OSError(errno.ENOTDIR, f"there is no folder {folder}", str(path))
    _old(place)
    return place


def descriptor_of(path: Path) -> int | None:
    """The descriptor of this process for which a path stands."""
    match DESCRIPTORS.fullmatch(str(path)):
        case None:
            return None
        case found:
            return int(found[1]) if found[1] else {"in": 0, "out": 1, "err": 2}[found[2]]


def refuse(path: Path) -> None:
    """OSError where nothing could be written to a path that a user has named; looked at before any work is done."""
    if descriptor_of(path) is not None or _takes_all(path):
        return
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


def _old(path: Path) -> os.stat_result | None:
    """What stands at a path and can be replaced, a file or the one to which a link leads; None where there is none."""
    try:
        own = path.lstat()
        old = path.stat() if stat.S_ISLNK(own.st_mode) else own
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(old.st_mode):
        raise irregular(path, old.st_mode)
    return old


def _start(path: Path, most: int) -> bytes | None:
    try:
        return read_regular(path, most)
    except FileNotFoundError:
        return None


def _takes_all(path: Path) -> bool:
    """Whether a path leads to something that takes whatever is written: no disk, no folder, no socket."""
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError):
        return False
    return stat.S_ISCHR(mode) or stat.S_ISFIFO(mode)


@contextmanager
def _opened(path: Path) -> Iterator[int]:
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC)
    except OSError as error:
        if error.errno == errno.ENXIO:
            raise OSError(errno.ENXIO, "nobody reads what is written there", str(path)) from error
        raise
    try:
        os.set_blocking(descriptor, True)
        yield descriptor
    finally:
        os.close(descriptor)


def _write_all(descriptor: int, data: Data) -> None:
    for part in _parts(data):
        rest = memoryview(part)
        while rest:
            rest = rest[os.write(descriptor, rest) :]


def _parts(data: Data) -> Iterable[bytes]:
    return (data,) if isinstance(data, bytes) else data
