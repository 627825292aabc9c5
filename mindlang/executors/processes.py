"""Processes on this machine, which share its cores."""

from collections.abc import Callable

from mindrun.processors import cores
from mindrun.work.assignment import Assignment
from mindrun.work.executor import JobExecutor
from mindrun.work.local import local_workers

USAGE = "processes:N"
MAX_PROCESSES = 1024
MAX_DIGITS = 4


def flaw(argument: str) -> str:
    """What is wrong with a number of processes; nothing where nothing is."""
    if not (argument.isascii() and argument.isdigit() and len(argument) <= MAX_DIGITS):
        return "it is no whole number"
    return "" if 1 <= int(argument) <= MAX_PROCESSES else f"it is not from 1 to {MAX_PROCESSES}"


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """So many processes."""
    count = int(argument)
    return local_workers(count, max(1, cores() // count), assignment)
