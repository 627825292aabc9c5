"""What was taught alone, after what was learnt on top: python -m benchmarks.wankelmut --seeds 801 802 803 804 805.

examples/wankelmut taught from nothing with each seed, and how Waver does in 100 runs that no training has seen. Up and
Down do their own tasks in 400 such runs before Waver has learnt and after it, and the scores are compared to the bit.
What monoliths come to in as many steps: python examples/beside.py examples/wankelmut.
"""

import argparse
from pathlib import Path
from shutil import copy
from tempfile import TemporaryDirectory

import mindlang
from benchmarks.workloads import COLLECT
from mindlang.run.setup import NO_GENOME, layouts

SOLVED_PERCENT = 95
FRESH_RUNS, ALONE_RUNS, UNSEEN_SEED = 100, 400, 9
ALONE = "Up", "Down"


def alone(path: Path, skill: str) -> bytes:
    """The weights of a skill, and the score of each of its own runs."""
    mind = mindlang.load(path)
    found = mind.rollout(skill, skill).score(NO_GENOME, layouts(UNSEEN_SEED, ALONE_RUNS)).total
    return bytes(mind.policy(skill).weights[skill].tobytes() + found.tobytes())


def taught(seed: int, folder: Path) -> str:
    """How a seed does, and which skills do their own tasks as before."""
    path = Path(copy(COLLECT.parents[1] / "wankelmut" / "wankelmut.mind", folder))
    mindlang.load(path).train(*ALONE, seed=seed, runs=folder)
    before = {skill: alone(path, skill) for skill in ALONE}
    mindlang.load(path).train("Waver", seed=seed, runs=folder)
    kept = [skill for skill in ALONE if alone(path, skill) == before[skill]]
    rollout = mindlang.load(path).rollout("Wankelmut", "Waver")
    found = rollout.score(NO_GENOME, layouts(UNSEEN_SEED, FRESH_RUNS)).total[0]
    solved = f"solved in {(found >= SOLVED_PERCENT).sum()} of {FRESH_RUNS} runs"
    return f"{found.mean():.1f} % right, {solved}, as before: {', '.join(kept) or 'none'}"


def main() -> None:
    """Teach with each seed, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("--seeds", type=int, nargs="+", default=[801, 802, 803, 804, 805])
    for seed in parser.parse_args().seeds:
        with TemporaryDirectory() as folder:
            print(f"seed {seed}: {taught(seed, Path(folder))}", flush=True)


if __name__ == "__main__":
    main()
