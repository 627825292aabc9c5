"""What `varies` is worth: python benchmarks/varies.py [--seeds 5] [--runs 200] [--workers N] [--json].

examples/line/line.mind is taught with cars that differ by 20 %, fixed.mind beside it with one car. Each is taught from
nothing with so many seeds, and then drives cars that differ by 30 % and that no lesson had (the task Unseen). Asked is
that the mean score with `varies` is 1.3 times that without. Of each training stand the mean and, beside the means of
all trainings, the standard error over trainings.
"""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from shutil import copy
from tempfile import TemporaryDirectory

import numpy as np
from mindrun.processors import cores

import mindlang

FOLDER = Path(__file__).parents[1] / "examples" / "line"
SOURCES = "line.mind", "fixed.mind", "track.txt"
TAUGHT = {"with varies": "line.mind", "without": "fixed.mind"}
TASKS = "Unseen", "Fixed"
ASKED_RATIO = 1.3


def taught(name: str, seed: int, runs: int, workers: int) -> dict[str, float]:
    """The scores of one training of a file, by task, from nothing and beside nothing."""
    with TemporaryDirectory() as folder:
        for source in SOURCES:
            copy(FOLDER / source, folder)
        mind = mindlang.load(Path(folder, name))
        mind.train("Follow", seed=seed, workers=workers, runs=Path(folder, "runs"))
        return {task: mind.bench(task, runs=runs, workers=workers)["score_mean"] for task in TASKS}


def mean(values: Sequence[float]) -> tuple[float, float]:
    """The mean, and its standard error."""
    return float(np.mean(values)), float(np.std(values, ddof=1) / len(values) ** 0.5)


def main() -> None:
    """Teach, bench, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--workers", type=int, default=cores())
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    found: dict[str, list[dict[str, float]]] = {how: [] for how in TAUGHT}
    for seed in range(1, options.seeds + 1):
        for how, name in TAUGHT.items():
            found[how].append(taught(name, seed, options.runs, options.workers))
            if not options.json:
                scores = ", ".join(f"{task} {score:6.2f}" for task, score in found[how][-1].items())
                print(f"seed {seed}, {how:11}: {scores}", flush=True)
    means = {how: {task: mean([each[task] for each in scores]) for task in TASKS} for how, scores in found.items()}
    ratio = means["with varies"]["Unseen"][0] / means["without"]["Unseen"][0]
    if options.json:
        print(json.dumps({"trainings": found, "means": means, "ratio": ratio}))
        return
    for how, tasks in means.items():
        said = ", ".join(f"{task} {score:.1f} ± {error:.1f}" for task, (score, error) in tasks.items())
        print(f"{how:11}: {said}")
    print(f"on cars never seen {ratio:.2f} times the score; asked {ASKED_RATIO}")


if __name__ == "__main__":
    main()
