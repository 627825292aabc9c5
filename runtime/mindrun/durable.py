"""Writing a file so that a crash at any moment leaves either the old one or the new one."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def write(path: Path, data: bytes) -> None:
    """Replace `path` by `data`, on the disk before this returns; an OSError leaves the old file as it was."""
    write_beside(path, data).replace(path)
    sync_folder(path.parent)


def write_beside(path: Path, data: bytes) -> Path:
    """Write `data` to a temporary file beside `path`, on the disk; its path. One process at a time may do that.

    It may be read and written by the same people as `path`.
    """
    beside = spare(path)
    try:
        beside.unlink(missing_ok=True)
        with beside.open("xb") as file:
            if path.exists():
                os.fchmod(file.fileno(), path.stat().st_mode & 0o7777)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        beside.unlink(missing_ok=True)
        raise
    return beside


def spare(path: Path) -> Path:
    """Where `path` is written first; what a crash leaves there nobody reads."""
    return path.with_name(f".{path.name}.mind-tmp")


@contextmanager
def alone(folder: Path) -> Iterator[None]:
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
