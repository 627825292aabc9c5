"""A command as it can be pasted into a shell."""

import shlex
from pathlib import Path


def command_line(*words: str | Path) -> str:
    """The words of a command, each whole: mindc train 'a mind.mind' Go.

    A word that is a Path names a file, and is never taken for an option: ./-x.mind.
    """
    return shlex.join(f"./{word}" if isinstance(word, Path) and str(word)[:1] == "-" else str(word) for word in words)
