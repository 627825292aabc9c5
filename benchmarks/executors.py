"""Attempts side by side, wherever: python benchmarks/executors.py [--generations 60] [--seeds 3] [--turns 3].

Two tables, of GoToObject on this machine: the SHA-256 of the weights for every executor and seed; what ten attempts
take one by one and side by side on the same cores, in turns. 1 where any weights differ. Workers that are killed:
killed_workers.py.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from statistics import median

import numpy as np
import psutil
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.policy import Policy
from mindrun.processors import cores
from mindrun.sim.rollout import Rollout
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin

from benchmarks.executor_kinds import Begin, dask, one_by_one, processes, threads
from benchmarks.workloads import collect
from mindlang.executors.jobs import Assignment

SKILL = "GoToObject"
SHOWN_CHARACTERS = 16  # of a hash


@dataclass(frozen=True, slots=True)
class Taught:
    """What a training came to: the hash of its weights, and the seconds that it took."""

    weights: str
    seconds: float


def main() -> None:
    """Teach on every executor, and print the tables."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--generations", type=int, default=60, help="of each of the ten attempts (default 60)")
    parser.add_argument("--seeds", type=int, default=3, help="of the first table (default 3)")
    parser.add_argument("--turns", type=int, default=3, help="of the second table (default 3)")
    options = parser.parse_args()
    assignment = assignment_of()
    is_same = [
        hashes(assignment, options.seeds),
        overhead(assignment, options.generations, options.turns),
    ]
    sys.exit(not all(is_same))


def assignment_of() -> Assignment:
    """What a worker has to know."""
    graph, weights, _ = collect()
    return Assignment(pack(Bundle(Policy(graph, weights), {})), SKILL, SKILL, (SKILL,))


def course_of(rollout: Rollout, attempts: int, generations: int, seed: int) -> Course:
    """The paper's lesson, shorter, from nothing."""
    lesson = next(each for each in collect()[0].lessons if each.skill == SKILL and each.curriculum == "Collect")
    learner = replace(lesson.learner, attempts=attempts)
    nothing = np.empty((0, rollout.genome_length), np.float32)
    return Course(replace(lesson, generations=generations, learner=learner), seed, nothing)


def rollout_of(assignment: Assignment, threads: int) -> Rollout:
    """What scores genomes in this process, compiled."""
    rollout = Rollout(unpack(assignment.bundle).policy, SKILL, SKILL, [SKILL], workers=threads)
    rollout.compile()
    return rollout


def taught(course: Course, rollout: Rollout, executor_of: Begin) -> Taught:
    """Teach a lesson, its attempts one by one or side by side."""
    began, executor = time.perf_counter(), executor_of(course, rollout)
    executor = executor or InThisThread(course, rollout, time.perf_counter)
    *_, last = side_by_side(course, executor, begin(course), lambda: False)
    state = last.state
    digest = sha256(state.kept.tobytes() + state.champions.tobytes()).hexdigest()
    return Taught(digest, time.perf_counter() - began)


EXECUTORS = {
    "1 thread": (one_by_one, 1),
    "2, one by one": (one_by_one, 2),
    "2 threads": (threads, 2),
    "2 processes": (processes, 2),
    "Dask, 1 worker": (dask, 1),
    "Dask, 2 workers": (dask, 2),
    "Dask, 4 workers": (dask, 4),
}


def hashes(assignment: Assignment, seeds: int) -> bool:
    """The weights by executor and seed; whether they are the same."""
    print(f"SHA-256 of the weights of four attempts of 15 generations, seeds 1 to {seeds}", flush=True)
    found = dict[str, list[str]]()
    for name, (make, count) in EXECUTORS.items():
        rollout = rollout_of(assignment, count if make in (one_by_one, threads) else 1)
        with make(count, assignment) as (executor, _):
            found[name] = [
                taught(course_of(rollout, 4, 15, seed), rollout, executor).weights for seed in range(1, seeds + 1)
            ]
        print(f"  {name:<16}", *(each[:SHOWN_CHARACTERS] for each in found[name]), flush=True)
    return len({tuple(each) for each in found.values()}) == 1


def overhead(assignment: Assignment, generations: int, turns: int) -> bool:
    """Ten attempts on the same cores, one by one and side by side, in turns; whether their weights are the same."""
    names = {"one by one": one_by_one, "threads": threads, "processes": processes, "Dask": dask}
    count = cores()
    rollout = rollout_of(assignment, count)
    course = course_of(rollout, 10, generations, 1)
    print(f"ten attempts of {generations} generations on {count} cores: seconds, and in brackets those of CPU time")
    weights, found = set[str](), list[dict[str, tuple[float, float]]]()
    for _ in range(turns):
        turn = dict[str, tuple[float, float]]()
        for name, make in names.items():
            with make(count, assignment) as (executor, pids):
                warm_up(rollout, executor)
                before = cpu_seconds(pids())
                done = taught(course, rollout, executor)
                turn[name] = done.seconds, cpu_seconds(pids()) - before
            weights.add(done.weights)
        found.append(turn)
        print("  " + ", ".join(f"{name} {wall:.1f} ({cpu:.1f})" for name, (wall, cpu) in turn.items()), flush=True)
    for name in names if found else ():
        wall, cpu = (median(turn[name][i] / turn["one by one"][i] for turn in found) for i in range(2))
        print(f"  {name:<10} {wall:.3f} times the seconds of one by one, {cpu:.3f} times their CPU time (medians)")
    return len(weights) <= 1


def cpu_seconds(pids: Sequence[int]) -> float:
    """CPU time of this process, where a scheduler may run, and of workers so far."""
    return time.process_time() + sum(sum(psutil.Process(pid).cpu_times()[:2]) for pid in pids)


def warm_up(rollout: Rollout, executor_of: Begin) -> None:
    """Let every worker begin and load what is compiled: two short attempts for each."""
    taught(course_of(rollout, 2 * cores(), 1, 9), rollout, executor_of)


if __name__ == "__main__":
    main()
