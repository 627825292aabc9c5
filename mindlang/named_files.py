"""The files that the words of a command line name: a file by itself, a folder by all that is in it and below."""

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from mindrun.errors import MindError

from mindlang.compiler.diagnostic import listed
from mindlang.file_search import MAX_FOLDER_ENTRIES, is_looked_into


def named_files(words: Iterable[str], *suffixes: str) -> list[str]:
    """Files as they were named, each folder as its files with one of these endings, in the order of their paths.

    MindError where a folder has none of them, has too many entries, or cannot be read.
    """
    return [file for word in words for file in (_of_folder(word, suffixes) if is_folder(word) else [word])]


def is_folder(word: str) -> bool:
    """Whether a word of a command line names a folder."""
    try:
        return Path(word).is_dir()
    except OSError:  # in a folder into which we may not look: why is said where it is read
        return False


def is_file(word: str) -> bool:
    """Whether a word of a command line names a file that is there."""
    try:
        return Path(word).is_file()
    except OSError:
        return False


def _of_folder(folder: str, suffixes: tuple[str, ...]) -> list[str]:
    found = [str(path) for path in _below(Path(folder)) if path.suffix in suffixes]
    if not found:
        hint = "Folders named build, dist, runs, venv or node_modules are left out below it, and hidden ones."
        raise MindError(f"{folder} has no {listed(suffixes)} file in it, nor in the folders below it.", hint)
    return found


def _below(folder: Path) -> Iterator[Path]:
    """The files in a folder and below it, sorted, without those of folders in which nobody writes minds."""
    left = MAX_FOLDER_ENTRIES
    for at, folders, files in os.walk(folder, onerror=_refuse):
        left -= len(folders) + len(files)
        if left < 0:
            hint = "Name a smaller folder, or the files."
            raise MindError(f"{folder} has more than {MAX_FOLDER_ENTRIES} files and folders below it.", hint)
        folders[:] = sorted(name for name in folders if is_looked_into(name))
        yield from (Path(at, name) for name in sorted(files) if not name.startswith("."))


def _refuse(error: OSError) -> None:
    raise MindError(f"The folder {error.filename} cannot be read: {error.strerror}.", "Name the files instead.")
