"""Processes on this machine, which share its cores."""

import sys

from mindrun.work.assignment import Assignment
from mindrun.work.crew import Crew, Place
from mindrun.work.executor import Executor

USAGE = "processes:N"
MAX_PROCESSES = 1024
MAX_DIGITS = 4


def flaw(argument: str) -> str:
    """What is wrong with a number of processes; nothing where nothing is."""
    if not (argument.isascii() and argument.isdigit() and len(argument) <= MAX_DIGITS):
        return "it is no whole number"
    return "" if 1 <= int(argument) <= MAX_PROCESSES else f"it is not from 1 to {MAX_PROCESSES}"


def begin(argument: str, assignment: Assignment) -> Executor:
    """So many processes."""
    from mindrun.sim.rollout import cores

    count = int(argument)
    command = (sys.executable, "-m", "mindrun", "work", "--threads", str(max(1, cores() // count)))
    return Crew([Place(f"process {number}", command) for number in range(1, count + 1)], assignment)
