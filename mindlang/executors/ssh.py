"""Other machines by ssh: one worker on each, with all its cores."""

from collections.abc import Callable

from mindrun.work.assignment import Assignment
from mindrun.work.child import Place
from mindrun.work.crew import Crew
from mindrun.work.executor import JobExecutor

USAGE = "ssh:HOST[,HOST]…"
# Nobody is there to type a password, and a machine that is gone is noticed within a minute.
SSH = ("ssh", "-T", "-o", "BatchMode=yes", "-o", "ServerAliveInterval=15", "-o", "ServerAliveCountMax=3")


def flaw(argument: str) -> str:
    """What is wrong with a list of machines; nothing where nothing is."""
    hosts = argument.split(",")
    if not all(hosts):
        return "a machine has no name"
    wrong = next((host for host in hosts if host.startswith("-") or not host.isprintable() or " " in host), "")
    return f"{wrong!r:.40} is no machine" if wrong else ""


def begin(argument: str, assignment: Assignment, say: Callable[[str], object]) -> JobExecutor:
    """A worker on each machine."""
    hosts = argument.split(",")
    return Crew([Place(host, (*SSH, "--", host, "mindrun", "work")) for host in hosts], assignment, say=say)
