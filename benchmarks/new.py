"""From `mindc new` to a robot that is taught and drawn: python benchmarks/new.py [--seeds 5] [--only car-patrol].

Every robot with every task that it can do, each seed in a folder of its own: made, taught from nothing, run with a
picture, then tried on layouts that the training has not seen. A seed of which a lesson does not reach what it needs has
failed: it does not pass, and the figure is of the others. Figures go with the machine; docs/new.md has some.
"""

import argparse
import json
import os
import resource
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import mean
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.curriculum import MINDC, documents, mindc
from mindlang.templates import Robot, Task, missing, robots, tasks

LINE = "| {project} | {figure} | {good} of {seeds} | {cpu:.0f} s | {wall:.0f} s |"
HEAD = "| robot and task | mean of the seeds (worst) | its test passes | CPU time | wall time |\n|---|---|---|---|---|"


def made(robot: Robot, task: Task, seed: int, runs: int) -> dict[str, Any]:
    """One seed of a project: seconds from nothing to its picture, and what came of it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "rover"
        begin, cpu = time.perf_counter(), child_seconds()
        call(Path(folder), "new", path.name, "--robot", robot.name, "--task", task.name)
        taught = mindc(str(path), "train", "rover.mind", "--seed", str(seed))
        if taught.returncode == 0:
            call(path, "run", "rover.mind", "--seed", "1", "--picture", "rover.png")
        wall, cpu = time.perf_counter() - begin, child_seconds() - cpu
        if taught.returncode:
            return {"seed": seed, "cpu": cpu, "wall": wall, "passes": False, "why": taught.stderr.strip()}
        bench = mindc(str(path), "bench", "rover.mind", "--runs", str(runs), "--seed", "20261123")
        (found,) = documents(bench.stdout)
        words = (MINDC[0], "-m", "pytest", "-q", "-p", "no:cacheprovider")
        tested = subprocess.run(words, cwd=path, capture_output=True)
    return {"seed": seed, "cpu": cpu, "wall": wall, "passes": tested.returncode == 0, **figures(found)}


def figures(found: dict[str, Any]) -> dict[str, float]:
    """What a benchmark of many runs says, as numbers by their names."""
    counted = {event: each["mean"] for event, each in found["by_event"].items()}
    success = {"success": found["success"]["mean"]} if found.get("success") else {}
    ended = {f"ended by {why}": times / found["runs"] for why, times in found["ended"].items()}
    return {**success, **counted, "score": found["score_mean"], **ended}


def figure(runs: Sequence[dict[str, Any]]) -> str:
    """What matters most of the seeds that were taught, in words: successes, else what was counted, else the score."""
    runs = [run for run in runs if "why" not in run]
    if not runs:
        return "none was taught"
    name = next(name for name in runs[0] if name not in {"seed", "cpu", "wall", "passes"})
    values = [run.get(name, 0.0) for run in runs]
    match name:
        case "success":
            return f"{mean(values):.0%} succeed ({min(values):.0%})"
        case "score":
            return f"score {mean(values):.0f} ({min(values):.0f})"
        case _:
            return f"{mean(values):.1f} × {name} ({min(values):.1f})"


def call(folder: Path, *words: str) -> None:
    """A command of mindc that has to succeed."""
    subprocess.run([*MINDC, *words], cwd=folder, check=True, capture_output=True)


def child_seconds() -> float:
    """CPU seconds of all programs that have been called."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    """Make, teach, try, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--only", action="append", default=[], metavar="ROBOT-TASK")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    both = [(robot, task) for robot in robots().values() for task in tasks().values() if not missing(robot, task)]
    seeds = range(options.first_seed, options.first_seed + options.seeds)
    if not options.json:
        print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, {options.runs} runs of each seed\n\n{HEAD}")
    for robot, task in both:
        name = f"{robot.name}-{task.name}"
        if options.only and name not in options.only:
            continue
        runs = [made(robot, task, seed, options.runs) for seed in seeds]
        good = sum(run["passes"] for run in runs)
        times = {each: mean(run[each] for run in runs) for each in ("cpu", "wall")}
        row = {"project": name, "figure": figure(runs), "good": good, "seeds": len(runs), **times}
        print(json.dumps({"project": name, "runs": runs}) if options.json else LINE.format(**row), flush=True)


if __name__ == "__main__":
    main()
