"""Any command that is a worker: it takes frames on its standard input, and answers on its standard output."""

import shlex
from collections.abc import Callable

from mindrun.work.assignment import Assignment
from mindrun.work.child import Place
from mindrun.work.crew import Crew
from mindrun.work.executor import JobExecutor

USAGE = "command:WORDS, or command:N:WORDS for N of them"
MAX_COMMANDS = 1024


def flaw(argument: str) -> str:
    """What is wrong with a command; nothing where nothing is."""
    try:
        count, words = _split(argument)
    except ValueError as error:
        return f"{error}".lower()
    if not words:
        return "there are no words"
    return "" if 1 <= count <= MAX_COMMANDS else f"there are not 1 to {MAX_COMMANDS} of them"


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """The command, so many times."""
    count, words = _split(argument)
    names = [f"{words[0]} {number}" if count > 1 else words[0] for number in range(1, count + 1)]
    return Crew([Place(name, words) for name in names], assignment, say=say)


def _split(argument: str) -> tuple[int, list[str]]:
    """How many, and the words of the command; ValueError where a quotation is not closed."""
    count, colon, words = argument.partition(":")
    if colon and count.isascii() and count.isdigit() and len(count) <= len(str(MAX_COMMANDS)):
        return int(count), shlex.split(words)
    return 1, shlex.split(argument)
