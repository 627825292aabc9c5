"""Workers that are processes of this machine."""

import sys

from mindrun.work.assignment import Assignment
from mindrun.work.child import Place
from mindrun.work.crew import Crew
from mindrun.work.serving import STEP_SECONDS


def local_workers(count: int, threads: int, assignment: Assignment, step_seconds: int = STEP_SECONDS) -> Crew:
    """So many processes of so many threads each."""
    options = ["--threads", f"{threads}", "--step-seconds", f"{step_seconds}"]
    if assignment.folder:
        options += ["--folder", f"{assignment.folder.absolute()}"]
    command = (sys.executable, "-m", "mindrun", "work", *options)
    places = [Place(f"process {number}", command, writes_step=True) for number in range(1, count + 1)]
    return Crew(places, assignment)
