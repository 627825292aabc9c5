"""Writing a file so that a crash at any moment leaves either the old one or the new one."""

import os
from pathlib import Path


def write(path: Path, data: bytes) -> None:
    """Replace `path` by `data`, on the disk before this returns; an OSError leaves the old file as it was."""
    spare = write_beside(path, data)
    spare.replace(path)
    sync_folder(path.parent)


def write_beside(path: Path, data: bytes) -> Path:
    """Write `data` to a temporary file beside `path`, on the disk; its path. One process at a time may do that."""
    spare = path.with_name(f"{path.name}.tmp")
    try:
        with spare.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        spare.unlink(missing_ok=True)
        raise
    return spare


def sync_folder(folder: Path) -> None:
    """Bring the names in a folder to the disk, so that a rename survives a power cut."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
