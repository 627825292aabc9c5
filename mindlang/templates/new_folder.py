"""A folder that is made with all of its files or not at all, and never in the place of anything."""

import errno
import os
import re
from collections.abc import Mapping
from pathlib import Path
from shutil import rmtree

from mindrun.errors import MindError
from mindrun.files.atomic_write import sync_folder

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
MAX_NAME_CHARACTERS = 40


class FolderError(MindError):
    """A folder that cannot be made."""


def check_name(name: str) -> None:
    """FolderError where files, tests and robots cannot have this name."""
    if len(name) > MAX_NAME_CHARACTERS:
        raise FolderError(f"A name has at most {MAX_NAME_CHARACTERS} characters, this one {len(name)}.")
    if NAME.fullmatch(name) is None:
        raise FolderError(
            f"A project cannot be called {name!r}: a name is letters, digits and _, and begins with a letter.",
            _usable(name),
        )


def check_free(folder: Path) -> None:
    """FolderError where something is in the way: anything but an empty folder."""
    try:
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise FolderError(f"{folder} is there, and is no folder.", "Take another name.")
        if folder.is_dir() and any(folder.iterdir()):
            raise FolderError(f"{folder} is there, and not empty: nothing is overwritten.", "Take another name.")
    except OSError as error:
        raise FolderError(f"{folder} cannot be made: {error.strerror}.") from error


def make_folder(folder: Path, files: Mapping[str, str]) -> None:
    """Write files into a new folder; it has all of them as soon as it is there. FolderError where it cannot be made."""
    beside = folder.with_name(f".{folder.name}-{os.getpid()}.mind-tmp")
    try:
        beside.mkdir()
        for name, text in files.items():
            with (beside / name).open("x", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
        beside.rename(folder)  # takes the place of an empty folder, and of nothing else
        sync_folder(folder.parent)
    except OSError as error:
        if error.errno in {errno.ENOTEMPTY, errno.EEXIST, errno.ENOTDIR}:
            check_free(folder)
        raise FolderError(f"{folder} cannot be made: {error.strerror}.") from error
    finally:
        rmtree(beside, ignore_errors=True)


def _usable(name: str) -> str:
    """What could be meant: the same name with nothing but what may stand in one."""
    letters = re.sub(r"[^A-Za-z0-9_]+", "_", name.strip()).strip("_").lstrip("0123456789_")
    return f"Write {letters[:MAX_NAME_CHARACTERS]} instead." if letters else "Write rover, for example."
