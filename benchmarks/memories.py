"""Tasks that need a memory: python -m benchmarks.memories [corridor] [cpt] [pairs] [nest] --seeds 801 802 803 804 805.

The minds of examples/memories, taught from scratch with each seed in a folder of their own, then 400 runs on layouts
that no training has seen (100 of `cpt`, `pairs` and `nest`). `corridor` at lengths of 10 to 120 ticks, with its
register, with a cell in the place of it (which holds nothing by itself), and without a memory; `cpt` (AX-CPT) and
`pairs` (1-2-AX) with their registers and without; `nest` with noise of 2 % on odometers and compass.
"""

import argparse
from collections.abc import Callable, Iterator
from itertools import groupby
from math import hypot
from pathlib import Path
from statistics import fmean
from tempfile import TemporaryDirectory
from time import perf_counter

from mindrun.errors import MindError
from mindrun.sim.trace import trace

import mindlang
from benchmarks.workloads import COLLECT
from mindlang.compiler.compile import load
from mindlang.run.setup import set_up

Question = Callable[[dict[str, float]], tuple[str, bool] | None]
Changes = dict[str, dict[str, str]]
BENCH_RUNS, TRACED_RUNS, UNSEEN_SEED = 400, 100, 9
LENGTHS_TICKS = 10, 20, 60, 120
NEST_UNITS = 3.0
FORGETTING = {"memory note is register start 50%": "memory note is cell decay 0 start 50%"}
WITHOUT_NOTE = {"  reads note\n": ""}
WITHOUT_CUE = {"  reads cue\n": ""}
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
    """The share of pairs of 1-2-AX that are answered rightly."""
    yield from answers("pairs", pair, {"registers": {}, "no memory": WITHOUT_LETTERS}, seed, folder)


def cpt(seed: int, folder: Path) -> Iterator[str]:
    """The share of trials of AX-CPT that are answered rightly, and of those of each kind."""
    yield from answers("cpt", trial, {"register": {}, "no memory": WITHOUT_CUE}, seed, folder)


def answers(name: str, asks: Question, variants: Changes, seed: int, folder: Path) -> Iterator[str]:
    """A line for each variant of an example that asks."""
    for what, changes in variants.items():
        right = right_answers(taught(name, folder, changes, seed), asks)
        every = [each for kind in right.values() for each in kind]
        kinds = ", ".join(f"{kind} {fmean(right[kind]):.1%}" for kind in sorted(right))
        yield f"{what}: {fmean(every):.1%} of {len(every)}, {kinds}"


def pair(read: dict[str, float]) -> tuple[str, bool] | None:
    """What is asked in a tick of 1-2-AX, and whether the answer is yes; None where nothing is asked."""
    if read["inner"] < 0.58:
        return None
    kind = "12"[read["digit"] < 0.5] + "AB"[read["first"] < 0.5] + "XY"[read["second"] < 0.5]
    return kind, kind in ("1AX", "2BY")


def trial(read: dict[str, float]) -> tuple[str, bool] | None:
    """What is asked in a tick of AX-CPT, and whether the answer is yes; None where nothing is asked."""
    kind = "AB"[read["isB"] > 0.5] + "XY"[read["isY"] > 0.5]
    return (kind, kind == "AX") if read["asked"] > 0.5 else None


def right_answers(path: Path, asks: Question) -> dict[str, list[bool]]:
    """For each kind of question whether each was answered rightly: the lamp is right in every tick of the answer."""
    setup = set_up(str(path), load(path), None, None)
    graph, rollout = setup.ready.policy.graph, setup.rollout()
    rows = {sensor.name: sensor.start for sensor in graph.sensors}
    right: dict[str, list[bool]] = {}
    for seed in setup.layouts(UNSEEN_SEED, TRACED_RUNS):
        moments = [*trace(rollout, seed).moments]
        asked = [asks({name: float(each.readings[row]) for name, row in rows.items()}) for each in moments]
        said = [float(each.commands[0]) > 0.5 for each in moments]
        for question, ticks in groupby(zip(asked, said, strict=True), lambda tick: tick[0]):
            if question:
                kind, yes = question
                right.setdefault(kind, []).append(all(answer == yes for _, answer in ticks))
    return right


def nest(seed: int, folder: Path) -> Iterator[str]:
    """How far from the nest the robot says that it is there."""
    path = taught("nest", folder, {}, seed)
    setup = set_up(str(path), load(path), None, None)
    rollout = setup.rollout()
    away = sorted(hypot(*ended_at(rollout, layout)) for layout in setup.layouts(UNSEEN_SEED, TRACED_RUNS))
    share = sum(each <= NEST_UNITS for each in away) / len(away)
    yield f"{share:.0%} within {NEST_UNITS:g}, median {away[len(away) // 2]:.2f}, worst {away[-1]:.2f}"


def ended_at(rollout: object, layout: int) -> tuple[float, float]:
    """Where the robot is at the end of a run."""
    *_, last = trace(rollout, layout).moments  # type: ignore[arg-type]
    return float(last.body[0]), float(last.body[1])


def main() -> None:
    """Teach each with each seed, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("tasks", nargs="*", default=["corridor", "cpt", "pairs", "nest"])
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
