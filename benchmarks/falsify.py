"""What `mindc falsify` finds: python benchmarks/falsify.py [--planted 10] [--seconds 60]
[--corner 10] [--hard 4] [--workers N].

Planted is a failure of one layout in 3,000 that no number tells: asked is that 60 s find it, with so many seeds in
turn. The corner is one of two varied numbers, thrust and damping: asked is a tenth of the runs that it takes on any
layouts, which is 1 in the rate of failures there. Hard layouts are those on which the driver of examples/line fails: it
is taught on, with so many seeds, with a quarter of its layouts from these and without, and tried on any layouts and on
hard ones that no lesson had; the differences are by pairs, on the same layouts.
"""

import argparse
import subprocess
import sys
from pathlib import Path
from shutil import copytree, ignore_patterns
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np
from mindrun.processors import cores

from mindlang.compiler.compile import load
from mindlang.falsify.failures import Criterion
from mindlang.falsify.numbers import numbers_of
from mindlang.falsify.report import found_data, hard_text
from mindlang.falsify.search import Found, Search
from mindlang.run.setup import layouts, run_all, set_up

LINE = Path(__file__).parents[1] / "examples" / "line"
ASKED_SHARE = 0.1
CORNER_RUNS, USUAL_RUNS = 50, 100_000
TAUGHT_GENERATIONS, BENCHED_RUNS = 20, 2000
TAUGHT_SEED, TRIED_SEED = 1, 1001  # seeds of the layouts that a lesson has, and of those on which it is tried

HEAD = "tick 1/60 s\nmaster Go\n"
PLANTED = f"""{HEAD}\
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor ball_bearing is bearing of ball
skill Go is rule
  drives left_wheel at 0.5
  drives right_wheel at 0.5
task Wait in plain
  contains ball is item
  lasts 60 s
  ends when ball_bearing > 0.4 and ball_bearing < 0.4 + 1/3000
  rewards 0.01 per tick
"""
CORNER = f"""{HEAD}\
body Car is car size 3 2 linear_damping 2
actuator engine is motor thrust 600 neutral 0.5
sensor speed is speed range 100
skill Go is rule
  drives engine at 1
task Drive in plain
  varies thrust of engine 400 to 800
  varies linear_damping of Car 1 to 3
  lasts 2 s
  ends when speed > 0.7853
  rewards -speed per tick
"""
MORE = """\
use "line.mind"
master Follow
curriculum More is evolution_strategy layouts 12
  teaches Follow on Follow for {} generations {}
"""
MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
HARD = 'hard 25% of "hard.seeds"'


def search(file: Path, seed: int, workers: int, runs: int | None, seconds: float = 0.0) -> tuple[Found, float]:
    """What a search finds in the default task of a file, and the seconds that it took."""
    setup = set_up(str(file), load(file), None, None)
    rollout, began = setup.rollout(workers=workers), perf_counter()
    rollout.compile()
    numbers = numbers_of(setup.ready.policy.graph, setup.task)
    passed = lambda: (perf_counter() - began) / seconds if seconds else 0.0  # noqa: E731
    found = Search(rollout, Criterion(setup.task), numbers, seed, passed=passed).find(runs)
    return found, perf_counter() - began


def planted(file: Path, seeds: int, seconds: float, workers: int) -> str:
    """A sentence: with how many seeds a failure was found that one layout in 3,000 has."""
    file.write_text(PLANTED)
    first = []
    for seed in range(1, seeds + 1):
        found, took = search(file, seed, workers, None, seconds)
        run = found_data(found, seed)["first_failure"]
        first += [took * run / len(found.runs.places)] if run else []
    longest = f"after {max(first):.1f} s at most" if first else "never"
    return f"planted: found with {len(first)} of {seeds} seeds in {seconds:g} s, {longest}; asked is all of them"


def corner(file: Path, seeds: int, workers: int) -> str:
    """A sentence: after how many runs a corner of two numbers was found, and with how many seeds its region."""
    file.write_text(CORNER)
    rate = search(file, 1000, workers, USUAL_RUNS)[0].rate
    data = [found_data(search(file, seed, workers, CORNER_RUNS)[0], seed) for seed in range(1, seeds + 1)]
    first = [each["first_failure"] for each in data if each["first_failure"]]
    both = sum(bool(each["region"]) and len(each["region"]["numbers"]) == 2 for each in data)
    asked = ASKED_SHARE / rate.share
    return (
        f"corner: found with {len(first)} of {seeds} seeds, after {np.mean(first):.0f} runs in the mean, {max(first)} "
        f"at most; on any layouts it takes {1 / rate.share:.0f}, asked is {asked:.0f}; its region with {both}"
    )


def tried(file: Path, seeds: list[int], workers: int) -> np.ndarray:
    """Whether the driver of a file succeeds on each layout, as 1 and 0."""
    setup = set_up(str(file), load(file), "Follow", None)
    return 1.0 - Criterion(setup.task).failed(run_all(setup.rollout(workers=workers), seeds))


def hard(folder: Path, seeds: int, workers: int) -> list[str]:
    """Sentences: how much more often who was taught on hard layouts succeeds than who was not, by training."""
    copytree(LINE, folder, ignore=ignore_patterns("runs"), dirs_exist_ok=True)
    mind = folder / "line.mind"
    here, there = (search(mind, seed, workers, BENCHED_RUNS)[0] for seed in (TAUGHT_SEED, TRIED_SEED))
    (folder / "hard.seeds").write_text(hard_text(here, "benchmarks/falsify.py"))
    failing = there.uniform.seeds[there.criterion.failed(there.uniform.scores)].tolist()
    where = {"any layouts": layouts(TRIED_SEED + 1, BENCHED_RUNS), "hard layouts": failing}
    said, gained = [], {name: list[float]() for name in where}
    for seed in range(1, seeds + 1):
        came = {}
        for name, words in (("plain", ""), ("hard", HARD)):
            (file := folder / f"{name}{seed}.mind").write_text(MORE.format(TAUGHT_GENERATIONS, words))
            said_so = "--seed", str(seed), "--workers", str(workers), "--runs", str(folder / "runs"), "--force", "-q"
            subprocess.run([*MINDC, "train", str(file), "Follow", *said_so], check=True)
            came[name] = {name: tried(file, on, workers) for name, on in where.items()}
        for name in where:
            before, after = (came[each][name].mean() for each in ("plain", "hard"))
            gained[name].append(float(after - before))
            said.append(f"seed {seed}, {name}: {before:.1%} succeed without, {after:.1%} with hard ones")
            print(said[-1], flush=True)
    for name, each in gained.items():
        error = np.std(each, ddof=1) / np.sqrt(len(each)) if len(each) > 1 else float("nan")
        said.append(f"{name}: {100 * np.mean(each):+.1f} ± {100 * error:.1f} points with hard ones")
    return [f"before: {tried(mind, where['any layouts'], workers).mean():.1%} succeed on any layouts", *said[-2:]]


def main() -> None:
    """Search, teach, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    for name, usual in (("planted", 10), ("seconds", 60), ("corner", 10), ("hard", 4), ("workers", cores())):
        parser.add_argument(f"--{name}", type=int, default=usual)
    asked = parser.parse_args()
    with TemporaryDirectory() as made:
        folder = Path(made)
        if asked.planted:
            print(planted(folder / "planted.mind", asked.planted, asked.seconds, asked.workers), flush=True)
        if asked.corner:
            print(corner(folder / "corner.mind", asked.corner, asked.workers), flush=True)
        if asked.hard:
            print(*hard(folder / "line", asked.hard, asked.workers), sep="\n")


if __name__ == "__main__":
    main()
