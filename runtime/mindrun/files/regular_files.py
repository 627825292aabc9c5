"""Files that a user or a project names, read: only regular ones, so that none waits, and never more than is asked for.

A device is not even opened: for some that alone does something.
"""

import errno
import os
import stat
from pathlib import Path

READ_BYTES = 1 << 20  # read at once
IRREGULAR = {stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket", stat.S_IFLNK: "a link"}


def read_regular(path: Path, most: int) -> bytes:
    """The first `most` bytes of a regular file; OSError, with words of its own, where a path leads to anything else."""
    with open(open_regular(path), "rb", buffering=0) as file:
        parts, left = [], most
        while left and (part := file.read(min(left, READ_BYTES))):
            parts.append(part)
            left -= len(part)
    return b"".join(parts)


def read_whole(path: Path, most: int) -> bytes:
    """All of a regular file; OSError where it is larger than `most` bytes, too, of which nothing is read then."""
    if os.stat(path).st_size > most or len(data := read_regular(path, most + 1)) > most:  # noqa: PTH116
        raise OSError(errno.EFBIG, f"it is larger than {most >> 20} MiB", str(path))
    return data


def open_regular(path: Path) -> int:
    """A descriptor of a regular file, for reading; OSError where a path leads to anything else."""
    _refuse(path, os.stat(path))  # noqa: PTH116
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        _refuse(path, os.fstat(descriptor))  # it may be another by now
    except OSError:
        os.close(descriptor)
        raise
    return descriptor


def _refuse(path: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode):
        raise irregular(path, found.st_mode)


def irregular(path: Path, mode: int) -> OSError:
    """The error that says what a path is instead of a regular file."""
    number = errno.EISDIR if stat.S_ISDIR(mode) else errno.EINVAL
    return OSError(number, f"it is {IRREGULAR.get(stat.S_IFMT(mode), 'a device')}", str(path))
