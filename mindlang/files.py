"""Files in a folder, below it and in the folders above, and those that the words of a command line name.

What stands there is somebody else's and may be anything: a million files, loops of links, pipes, devices. So folders
are looked through up to so many entries, links to folders are not followed, and texts are read as sources are.
"""

import os
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from mindrun.errors import MindError
from mindrun.files.regular_files import read_regular

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.source import MAX_SOURCE_BYTES, decode_source

MAX_FOLDER_ENTRIES = 20_000  # of a folder, or of all folders below one, that are looked at
MAX_READ_FILES = 500  # that are read of all those around one
MAX_READ_CHARACTERS = 8 << 20  # of all of them together
SKIPPED_FOLDERS = ("node_modules", "build", "dist", "runs", "venv", "site-packages", "__pycache__")

Stamp = tuple[int, int] | None  # when a file was written, in ns, and how many bytes it has


def stamp(path: Path) -> Stamp:
    """The time and the length of a file, one of which is another once it has been written; None where there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size


def files_beside(folder: Path, suffix: str = ".mind") -> list[Path]:
    """The files of a folder with this ending, sorted; none where the folder cannot be read."""
    try:
        with os.scandir(folder) as entries:
            names = [entry.name for entry in islice(entries, MAX_FOLDER_ENTRIES)]
    except (OSError, ValueError):
        return []
    return sorted(folder / name for name in names if name.endswith(suffix))


def files_below(folder: Path, suffixes: tuple[str, ...] = (".mind",), strict: bool = False) -> Iterator[Path]:
    """The files in a folder and below it with one of these endings, but for hidden ones and those that programs fill.

    `strict` raises MindError where there are too many entries or a folder cannot be read; else these are left out.
    """
    left = MAX_FOLDER_ENTRIES
    for at, folders, files in os.walk(folder, onerror=_refuse if strict else None):
        seen = sorted(files)[:left]
        left -= len(folders) + len(files)
        if left < 0 and strict:
            hint = "Name a smaller folder, or the files."
            raise MindError(f"{folder} has more than {MAX_FOLDER_ENTRIES} files and folders below it.", hint)
        inside = (name for name in folders if not name.startswith(".") and name not in SKIPPED_FOLDERS)
        folders[:] = sorted(inside) if left > 0 else []
        yield from (Path(at, name) for name in seen if not name.startswith(".") and name.endswith(suffixes))


def _refuse(error: OSError) -> None:
    raise MindError(f"The folder {error.filename} cannot be read: {error.strerror}.", "Name the files instead.")


def named_files(words: Iterable[str], *suffixes: str) -> list[str]:
    """Files as they were named, each folder as its files with one of these endings, in the order of their paths.

    MindError where a folder has none of them, has too many entries, or cannot be read.
    """
    return [file for word in words for file in (_of_folder(word, suffixes) if is_folder(word) else [word])]


def _of_folder(folder: str, suffixes: tuple[str, ...]) -> list[str]:
    found = [str(path) for path in files_below(Path(folder), suffixes, strict=True)]
    if not found:
        hint = "Folders named build, dist, runs, venv or node_modules are left out below it, and hidden ones."
        raise MindError(f"{folder} has no {listed(suffixes)} file in it, nor in the folders below it.", hint)
    return found


def is_folder(word: str) -> bool:
    """True if a word of a command line names a folder; False without permission, which the reader reports."""
    return os.path.isdir(word)  # noqa: PTH112 (pathlib raises)


def folders_above(path: Path) -> list[Path]:
    """The folders from which a file can be used: its own and those above, but for the root of everything."""
    return [folder for folder in path.parents if folder != folder.parent]


def name_from_here(path: Path) -> str:
    """A file as a user calls it: its path from the working directory where it is in there, else the whole of it."""
    try:
        here = Path.cwd()
    except OSError:  # it has been removed
        return str(path)
    return str(path.relative_to(here)) if path.is_relative_to(here) else str(path)


def readable_text(path: Path) -> str:
    """The text of a source file; empty where it cannot be read."""
    try:
        return decode_source(read_regular(path, MAX_SOURCE_BYTES + 1))
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
