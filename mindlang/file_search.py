"""Finds files in a folder, below it and in the folders above, up to a limit of files and characters.

What stands there is somebody else's and may be anything: a million files, loops of links, pipes, devices. So folders
are looked through up to so many entries, links to folders are not followed, and texts are read as sources are.
"""

import os
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from mindrun.files.regular_files import read_regular

from mindlang.compiler.source import MAX_SOURCE_BYTES, decode

MAX_FOLDER_ENTRIES = 20_000  # of a folder, or of all folders below one, that are looked at
MAX_READ_FILES = 500  # that are read of all those around one
MAX_READ_CHARACTERS = 8 << 20  # of all of them together
SKIPPED_FOLDERS = ("node_modules", "build", "dist", "runs", "venv", "site-packages", "__pycache__")


def files_beside(folder: Path, suffix: str = ".mind") -> list[Path]:
    """The files of a folder with this ending, sorted; none where the folder cannot be read."""
    try:
        with os.scandir(folder) as entries:
            return sorted(
                folder / entry.name for entry in islice(entries, MAX_FOLDER_ENTRIES) if entry.name.endswith(suffix)
            )
    except (OSError, ValueError):
        return []


def files_below(folder: Path, suffix: str = ".mind") -> Iterator[Path]:
    """The files in a folder and in those below it, but for hidden ones and those in which nobody writes."""
    left = MAX_FOLDER_ENTRIES
    for at, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if is_looked_into(name))
        yield from (Path(at, name) for name in sorted(files)[:left] if name.endswith(suffix))
        left -= len(folders) + len(files)
        if left <= 0:
            return


def is_looked_into(folder: str) -> bool:
    """Whether a folder of this name may hold what people write: it is not hidden, and no program fills it."""
    return not folder.startswith(".") and folder not in SKIPPED_FOLDERS


def folders_above(path: Path) -> list[Path]:
    """The folders from which a file can be used: its own and those above, but for the root of everything."""
    return [folder for folder in path.parents if folder != folder.parent]


def name_from_here(path: Path) -> str:
    """What a user calls a file: its path from the working directory where it is in there, else the whole of it."""
    try:
        here = Path.cwd()
    except OSError:  # it has been removed
        return str(path)
    return str(path.relative_to(here)) if path.is_relative_to(here) else str(path)


def text_of(path: Path) -> str:
    """The text of a source file; None where it cannot be read or is none."""
    try:
        return decode(read_regular(path, MAX_SOURCE_BYTES + 1))
    except (OSError, RuntimeError, ValueError):  # a loop of links is a RuntimeError
        return ""


def within_read_limits(texts: Iterable[tuple[Path, str]]) -> Iterator[tuple[Path, str]]:
    """The first of these files with their texts: at most MAX_READ_FILES and MAX_READ_CHARACTERS."""
    left = MAX_READ_CHARACTERS
    for path, text in islice(texts, MAX_READ_FILES):
        left -= len(text)
        if left < 0:
            return
        yield path, text
