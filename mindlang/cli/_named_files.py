"""Files and folders that are named on a command line, and how many files those were."""

from collections.abc import Sequence


def files_of(words: Sequence[str], *suffixes: str) -> list[str]:
    """The files that are named, by themselves or by their folder; a folder without any ends the program."""
    from mindrun.errors import MindError

    from mindlang.cli._terminal import MISUSE, fail
    from mindlang.files import named_files

    try:
        return named_files(words, *suffixes)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)


def in_files(words: Sequence[str], files: Sequence[str]) -> str:
    """The end of a summary that says in how many files; empty where each of them was named by itself."""
    from mindlang.files import is_folder

    if not any(map(is_folder, words)):
        return ""
    return f" in {len(files)} file{'s' * (len(files) != 1)}"
