"""Tasks that need a memory: python -m benchmarks.memories [corridor] [pairs] [nest] --seeds 801 802 803 804 805.

The minds of examples/memories, taught from scratch with each seed in a folder of their own, then 400 runs on layouts
that no training has seen. `corridor` at lengths of 10 to 120 ticks, with its register, with a cell in the place of it
(which holds nothing by itself), and without a memory; `pairs` with its registers and without; `nest` with noise of 2 %
on odometers and compass.
"""

import argparse
from collections.abc import Iterator
from math import hypot
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from mindrun.errors import MindError
from mindrun.sim.trace import trace

import mindlang
from benchmarks.workloads import COLLECT
from mindlang.compiler.compile import load
from mindlang.run.setup import set_up

BENCH_RUNS, NEST_RUNS, UNSEEN_SEED = 400, 100, 9
LENGTHS_TICKS = 10, 20, 60, 120
NEST_UNITS = 3.0
FORGETTING = {"memory note is register start 50%": "memory note is cell decay 0 start 50%"}
WITHOUT_NOTE = {"  reads note\n": ""}
WITHOUT_LETTERS = {"  reads context\n": "", "  reads letter\n": ""}


def taught(name: str, folder: Path, changes: dict[str, str], seed: int) -> Path:
    """The file of an example with some of its text changed, taught as far as it can be."""
    path, text = folder / f"{name}.mind", (COLLECT.parents[1] / "memories" / f"{name}.mind").read_text(encoding="utf-8")
    for old, new in changes.items():
        if old not in text:
            raise MindError(f"{name}.mind has no {old!r}")
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    mindlang.load(path).train(seed=seed, runs=folder / "runs")
    return path


def success(path: Path) -> float:
    """The share of runs that succeed; 0 where no attempt has passed."""
    try:
        found = mindlang.load(path).bench(runs=BENCH_RUNS, seed=UNSEEN_SEED)
    except MindError:
        return 0.0
    return float(found["success"]["mean"])


def corridor(seed: int, folder: Path) -> Iterator[str]:
    """The share of right turns at each length."""
    for what, changes in {"register": {}, "cell": FORGETTING, "no memory": WITHOUT_NOTE}.items():
        shares = []
        for ticks in LENGTHS_TICKS:
            needs = {" needs success > 97%": ""} if what != "register" else {}
            path = taught("corridor", folder, {"is 120": f"is {ticks}", **changes, **needs}, seed)
            shares.append(f"{ticks} {success(path):.1%}")
        yield f"{what}: {', '.join(shares)}"


def pairs(seed: int, folder: Path) -> Iterator[str]:
    """The share of pairs that are answered rightly, of what can be had in each."""
    for what, changes in {"registers": {}, "no memory": WITHOUT_LETTERS}.items():
        path = taught("pairs", folder, changes, seed)
        lines = mindlang.load(path).bench(runs=BENCH_RUNS, seed=UNSEEN_SEED)
        yield f"{what}: {right_answers(path):.1%} of pairs, score {lines['score_mean']:.2f}"


def right_answers(path: Path) -> float:
    """The share of pairs in which the lamp is right in every tick of the answer."""
    setup = set_up(str(path), load(path), None, None)
    graph, rollout, right, asked = setup.ready.policy.graph, setup.rollout(), 0, 0
    rows = {sensor.name: sensor.start for sensor in graph.sensors}
    for seed in setup.layouts(UNSEEN_SEED, NEST_RUNS):
        pair: list[bool] = []
        for moment in trace(rollout, seed).moments:
            read = {name: float(moment.readings[row]) for name, row in rows.items()}
            if read["inner"] > 0.58:
                same = read["first"] == read["second"] == read["digit"]
                pair.append((float(moment.commands[0]) > 0.5) == same)
            elif pair:
                right, asked, pair = right + all(pair), asked + 1, []
    return right / asked


def nest(seed: int, folder: Path) -> Iterator[str]:
    """How far from the nest the robot says that it is there."""
    path = taught("nest", folder, {}, seed)
    setup = set_up(str(path), load(path), None, None)
    rollout = setup.rollout()
    away = sorted(hypot(*ended_at(rollout, layout)) for layout in setup.layouts(UNSEEN_SEED, NEST_RUNS))
    share = sum(each <= NEST_UNITS for each in away) / len(away)
    yield f"{share:.0%} within {NEST_UNITS:g}, median {away[len(away) // 2]:.2f}, worst {away[-1]:.2f}"


def ended_at(rollout: object, layout: int) -> tuple[float, float]:
    """Where the robot is at the end of a run."""
    *_, last = trace(rollout, layout).moments  # type: ignore[arg-type]
    return float(last.body[0]), float(last.body[1])


def main() -> None:
    """Teach each with each seed, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("tasks", nargs="*", default=["corridor", "pairs", "nest"])
    parser.add_argument("--seeds", type=int, nargs="+", default=[801, 802, 803, 804, 805])
    asked = parser.parse_args()
    for task in asked.tasks:
        for seed in asked.seeds:
            began = perf_counter()
            with TemporaryDirectory() as folder:
                for line in globals()[task](seed, Path(folder)):
                    print(f"{task} {seed} {line}", flush=True)
            print(f"{task} {seed} took {perf_counter() - began:.0f} s", flush=True)


if __name__ == "__main__":
    main()
