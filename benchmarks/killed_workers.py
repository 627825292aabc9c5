"""Workers killed at random moments: python benchmarks/killed_workers.py [--kills 50] [--apart 1] [--only NAME].

Ten attempts of GoToObject by two workers of this machine, undisturbed and with SIGKILL 0.5 to 5.5 s after each other,
again and again until there were so many kills: processes; workers of Dask whose nannies begin them again;
jobs of a cluster, worker and nanny at once, which are begun again as SLURM does. 1 where any weights differ.
"""

import argparse
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Event, Thread

import psutil
from distributed import Client

from benchmarks.executor_kinds import Begin, processes
from benchmarks.executors import SHOWN_CHARACTERS, Taught, assignment_of, course_of, rollout_of, taught
from mindlang.executors.cluster_jobs import ClusterJobs
from mindlang.executors.dask import connect, destination
from mindlang.executors.jobs import Assignment, StretchExecutor

MIN_KILL_SECONDS, MAX_KILL_SECONDS = 0.5, 5.5  # between two kills
WORKER_COUNT = 2
BEGIN_SECONDS = 60.0  # for a scheduler and its workers to be there

Kills = dict[int, Callable[[], object]]  # what kills each worker that is there, by its process
FindKills = Callable[[], Kills]


@dataclass(slots=True)
class ClusterJob:
    """A worker of one thread and its nanny in a session of their own, as SLURM begins them."""

    name: str
    scheduler_file: Path
    process: "subprocess.Popen[bytes]" = field(init=False)

    def __post_init__(self) -> None:
        """Begin both."""
        self.begin()

    def begin(self) -> None:
        """Begin both."""
        words = ("--scheduler-file", f"{self.scheduler_file}", "--nthreads", "1", "--name", self.name)
        self.process = dask("worker", *words, "--no-dashboard")

    def worker(self) -> int | None:
        """The process of the worker; None where there is none at this moment."""
        if self.process.poll() is not None:
            raise RuntimeError(f"the nanny of {self.name} has given up")
        children = psutil.Process(self.process.pid).children()
        return next((each.pid for each in children if any("spawn_main" in word for word in words_of(each))), None)

    def end(self) -> None:
        """Kill both."""
        end(self.process)

    def end_and_begin(self) -> None:
        """Kill both, and begin them again."""
        self.end()
        self.begin()


@contextmanager
def pooled(assignment: Assignment) -> Iterator[tuple[Begin, FindKills]]:
    """Processes, begun again by who asks them."""
    with processes(WORKER_COUNT, assignment) as (executor, pids):
        yield executor, lambda: {pid: partial(os.kill, pid, signal.SIGKILL) for pid in pids()}


@contextmanager
def clustered(assignment: Assignment, is_whole_job: bool) -> Iterator[tuple[Begin, FindKills]]:
    """A scheduler and its workers, begun by the commands of docs/cluster.md; kills are of workers, or of whole jobs."""
    with TemporaryDirectory() as folder, ExitStack() as stack:
        file = Path(folder, "scheduler.json")
        place = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        stack.callback(end, dask("scheduler", "--scheduler-file", f"{file}", *place))
        wait_for(file.exists)
        members = [ClusterJob(f"worker-{number}", file) for number in range(WORKER_COUNT)]
        for member in members:
            stack.callback(member.end)
        client = stack.enter_context(connect(destination(f"{file}")))
        wait_for(lambda: len(registered(client)) == WORKER_COUNT)

        def kills() -> Kills:
            there = registered(client)
            found = {member.worker(): member for member in members if member.name in there}
            return {
                pid: member.end_and_begin if is_whole_job else partial(os.kill, pid, signal.SIGKILL)
                for pid, member in found.items()
                if pid is not None
            }

        jobs = ClusterJobs(connect(destination(f"{file}")), assignment, lambda line: print(f"  {line}", flush=True))
        stack.callback(jobs.close)
        yield lambda course, rollout: StretchExecutor(course, jobs), kills


def dask(*words: str) -> "subprocess.Popen[bytes]":
    """A command of Dask in a session of its own, silent."""
    nothing = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-m", "dask", *words], stdout=nothing, stderr=nothing, start_new_session=True
    )


def end(process: "subprocess.Popen[bytes]") -> None:
    """Kill a session."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def words_of(process: psutil.Process) -> list[str]:
    """The command line of a process; none of one that has ended."""
    try:
        words: list[str] = process.cmdline()
    except psutil.Error:
        return []
    return words


def registered(client: Client) -> set[str]:
    """The names of the workers that the scheduler knows now."""
    return {each["name"] for each in client.scheduler_info(n_workers=-1)["workers"].values()}


def wait_for(there: Callable[[], bool]) -> None:
    """Wait until something is there; TimeoutError where it takes too long."""
    until = time.monotonic() + BEGIN_SECONDS
    while not there():
        if time.monotonic() > until:
            raise TimeoutError("the cluster does not begin")
        time.sleep(0.1)


EXECUTORS: dict[str, Callable[[Assignment], AbstractContextManager[tuple[Begin, FindKills]]]] = {
    "processes": pooled,
    "Dask, workers": partial(clustered, is_whole_job=False),
    "Dask, whole jobs": partial(clustered, is_whole_job=True),
}


def main() -> None:
    """Teach with each executor, and print what came of it."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--generations", type=int, default=60, help="of each of the ten attempts (default 60)")
    parser.add_argument("--kills", type=int, default=50, help="with each executor (default 50)")
    parser.add_argument("--only", choices=[*EXECUTORS], help="one executor alone")
    parser.add_argument("--apart", type=float, default=1.0, help="times so long between two kills, on a busy machine")
    options = parser.parse_args()
    apart = MIN_KILL_SECONDS * options.apart, MAX_KILL_SECONDS * options.apart
    print(f"{options.kills} kills at random moments, {apart[0]:g} to {apart[1]:g} s apart, of two workers", flush=True)
    assignment = assignment_of()
    rollout = rollout_of(assignment, 1)
    course, weights = course_of(rollout, 10, options.generations, 1), set[str]()
    for name in [options.only] if options.only else EXECUTORS:
        with EXECUTORS[name](assignment) as (executor, find_kills):
            weights |= measured(name, options.kills, lambda: taught(course, rollout, executor), find_kills, apart)
    sys.exit(len(weights) != 1)


def measured(
    name: str, count: int, teach: Callable[[], Taught], find_kills: FindKills, apart: tuple[float, float]
) -> set[str]:
    """Teach undisturbed, then again until there were so many kills; print what they cost. All weights that came of it.

    The first training of all lets the workers load what is compiled, and is not counted.
    """
    weights = {teach().weights}
    whole, disturbed, total = teach(), list[Taught](), 0
    draw = random.Random(1)
    while total < count:
        with killing(find_kills, count - total, draw, apart) as killed:
            disturbed.append(teach())
        total += len(killed)
        weights.add(disturbed[-1].weights)
    weights.add(whole.weights)
    lost = sum(each.seconds - whole.seconds for each in disturbed)
    print(
        f"  {name:<16} {total} kills in {len(disturbed)} trainings, {whole.seconds:.1f} s undisturbed,"
        f" {sum(each.seconds for each in disturbed) / len(disturbed):.1f} s with them:"
        f" {lost / max(1, total):.2f} s a kill; weights {' '.join(each[:SHOWN_CHARACTERS] for each in weights)}",
        flush=True,
    )
    return weights


@contextmanager
def killing(find_kills: FindKills, most: int, draw: random.Random, apart: tuple[float, float]) -> Iterator[list[int]]:
    """Kill a random worker now and then that was there at the look before, at most so many; who was killed."""
    killed, over = list[int](), Event()

    def kill() -> None:
        before = set[int]()
        while len(killed) < most and not over.wait(draw.uniform(*apart)):
            there = find_kills()
            if found := [pid for pid in there if pid in before and pid not in killed]:
                killed.append(draw.choice(found))
                there[killed[-1]]()
            before = {*there}

    thread = Thread(target=kill)
    thread.start()
    try:
        yield killed
    finally:
        over.set()
        thread.join()


if __name__ == "__main__":
    main()
