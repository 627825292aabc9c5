"""Agent-ticks per second of CPU time for many workloads: python benchmarks/rates.py [--against COMMIT] [NAME…].

With --against, a commit's checkout and this one take turns, a process each, and the ratio is printed beside the rates,
with the range in which half of all turns lie; each measures itself, with its own copy of this program: one that had
none yet cannot be compared. CPU time is of all threads; `first start` is the CPU time in seconds of an import and a
compilation into an empty cache, by processes of its own too, and its ratio is of the speeds.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np
from mindrun.graph.policy import Policy
from mindrun.kinds.learners import Genetic
from mindrun.sim.rollout import Rollout
from mindrun.train.ask_and_tell import mutate

from benchmarks.workloads import STUCK_SEED, Lanes, collect, random_weights, with_obstacles, with_skills

ROOT = Path(__file__).resolve().parent.parent
AGENT_TICKS = 400_000  # agent-ticks of a measurement; a lesson's is a generation
START = "first start, seconds of CPU time"
Measure = Callable[[], float]


def steady(ready: Callable[[], Lanes]) -> Callable[[], Measure]:
    """Robots whose runs never end."""

    def prepared() -> Measure:
        lanes = ready()
        ticks = max(1, AGENT_TICKS // (lanes.lanes * len(lanes.parts)))
        return lambda: lanes.rate(ticks, time.process_time)

    return prepared


def lanes_of(count: int, workers: int = 1, frozen: bool = False) -> Callable[[], Measure]:
    """The whole hierarchy, with genomes of their own for the master unless it is frozen."""

    def ready() -> Lanes:
        graph, weights, _ = collect()
        return Lanes(graph, weights, None if frozen else graph.master, count, workers)

    return steady(ready)


def lesson(skill: str) -> Callable[[], Measure]:
    """A generation late in a lesson: shipped weights and what mutation makes of them, runs that end and begin."""

    def prepared() -> Measure:
        graph, weights, _ = collect()
        others = {name: array for name, array in weights.items() if name != skill}
        rollout = Rollout(Policy(graph, others), skill, skill, [skill], workers=2)
        learner = Genetic()
        bred = mutate(np.repeat(weights[skill][None], learner.population, axis=0), learner, np.random.default_rng(1))
        rollout.compile()

        def measure() -> float:
            began = time.process_time()
            ticks = int(rollout.score(bred, [*range(1, learner.layouts + 1)]).ticks.sum())
            return ticks / (time.process_time() - began)

        return measure

    return prepared


def stuck() -> Lanes:
    """Robots that push against obstacles."""
    graph, _, _ = collect()
    return Lanes(graph, random_weights(graph, STUCK_SEED), graph.master)


def crowded() -> Lanes:
    """169 obstacles."""
    graph, weights, _ = collect()
    return Lanes(with_obstacles(graph, 7), weights, graph.master)


def skilled(count: int) -> Lanes:
    """Robots with so many skills, all under influence, that keep moving."""
    return Lanes(*with_skills(count))


WORKLOADS: Mapping[str, Callable[[], Measure]] = {
    "Collect, own genomes, 256 lanes": lanes_of(256),
    "Collect, all frozen, 256 lanes": lanes_of(256, frozen=True),
    "Collect, 64 lanes": lanes_of(64),
    "Collect, 16 lanes": lanes_of(16),
    "Collect, two workers of 100 lanes": lanes_of(100, workers=2),
    "population 50, one layout, two workers": lanes_of(25, workers=2),
    "population 50 on two layouts or 100 on one, two workers": lanes_of(50, workers=2),
    "lesson GoToObject, two workers": lesson("GoToObject"),
    "lesson Avoid, two workers": lesson("Avoid"),
    "lesson GoToObject+Avoid, two workers": lesson("GoToObject+Avoid"),
    "lesson Collect, two workers": lesson("Collect"),
    "stuck robots": steady(stuck),
    "169 obstacles": steady(crowded),
    **{f"{count} skills that move": steady(partial(skilled, count)) for count in (2, 10, 50)},
}


def first_start() -> float:
    """Seconds of CPU time of an import and a compilation into an empty cache, with all processes that this starts."""
    program = (
        "from benchmarks.workloads import collect; from mindrun.graph.policy import Policy;"
        "from mindrun.sim.rollout import Rollout; import os; graph, weights, _ = collect();"
        "Rollout(Policy(graph, weights), graph.master, graph.master).compile(); print(sum(os.times()[:4]))"
    )
    with tempfile.TemporaryDirectory() as cache:
        environment = os.environ | {"NUMBA_CACHE_DIR": cache}
        said = subprocess.run(  # in a folder with no modules of its own: -c looks there first
            [sys.executable, "-c", program], cwd=cache, env=environment, check=True, capture_output=True
        )
    return float(said.stdout)


def measured(name: str) -> float:
    """A workload once, after a first time that counts for nothing."""
    if name == START:
        return first_start()
    measure = WORKLOADS[name]()
    measure()
    return measure()


@contextmanager
def checkout(commit: str) -> Iterator[Path]:
    """A commit's files, in a folder that is gone afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        packed = subprocess.run(["git", "archive", commit], cwd=ROOT, check=True, capture_output=True).stdout
        subprocess.run(["tar", "-x", "-C", folder], input=packed, check=True)
        yield Path(folder)


@contextmanager
def measuring(root: Path, cache: Path, name: str) -> Iterator[Measure]:
    """What a checkout's own program measures of itself, in a process of its own that is ready."""
    folders = (root / "benchmarks", root, root / "runtime")  # where older ones look for their neighbours
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, folders)), "NUMBA_CACHE_DIR": str(cache)}
    command, pipe = [sys.executable, "-c", MEASURING, name], subprocess.PIPE
    with subprocess.Popen(command, cwd=cache, env=environment, stdin=pipe, stdout=pipe, text=True) as process:
        assert process.stdin
        assert process.stdout
        asked, told = process.stdin, process.stdout
        told.readline()

        def measure() -> float:
            print(file=asked, flush=True)
            return float(told.readline())

        yield measure


MEASURING = """
import sys, rates
measure = rates.first_start
if sys.argv[1] in rates.WORKLOADS:
    measure = rates.WORKLOADS[sys.argv[1]]()
    measure()
print(flush=True)
for _ in sys.stdin:
    print(measure(), flush=True)
"""


def take_turns(commit: str, names: list[str], rounds: int) -> None:
    """Print the medians of both, the median of their ratios, and between which two half of these lie.

    A ratio is of a measurement here to the two of the commit before and after it: what a busy machine takes from one,
    it takes from the others.
    """
    print(f"{'medians of ' + str(rounds) + ' rounds':<56}{commit[:9]:>10}{'here':>10}{'ratio':>8}{'half of them':>15}")
    with checkout(commit) as before, tempfile.TemporaryDirectory() as caches:
        sides = [(root, Path(caches) / side) for root, side in ((before, "a"), (ROOT, "b"))]
        for _, cache in sides:
            cache.mkdir()
        for name in names:
            with measuring(*sides[0], name) as theirs, measuring(*sides[1], name) as ours:
                found = [(theirs(), ours(), theirs()) for _ in range(rounds if name != START else 1)]
            ratios = sorted(new / ((old + again) / 2) for old, new, again in found)
            if name == START:
                ratios = [1 / ratio for ratio in ratios]
            old, new = median(old for old, _, _ in found), median(new for _, new, _ in found)
            half = f"{ratios[len(ratios) // 4]:.2f} to {ratios[3 * len(ratios) // 4]:.2f}"
            print(f"{name:<56}{_said(name, old):>10}{_said(name, new):>10}{median(ratios):>8.3f}{half:>15}", flush=True)


def _said(name: str, value: float) -> str:
    return f"{value:.1f} s" if name == START else f"{value / 1e6:.2f} M"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="only workloads whose name contains one of these")
    parser.add_argument("--against", metavar="COMMIT", help="another commit takes turns with this checkout")
    parser.add_argument("--rounds", type=int, help="turns with --against (default: 20), else measurements (default: 3)")
    options = parser.parse_args()
    names = [
        name
        for name in (*WORKLOADS, START)
        if not options.names or any(part.lower() in name.lower() for part in options.names)
    ]
    if not names:
        parser.error(f"no workload is called that; there are: {'; '.join((*WORKLOADS, START))}")
    if options.against:
        take_turns(options.against, names, options.rounds or 20)
        return
    for name in names:
        rounds = [measured(name) for _ in range(1 if name == START else options.rounds or 3)]
        print(f"{name:<56}{_said(name, median(rounds)):>10}", flush=True)


if __name__ == "__main__":
    main()
