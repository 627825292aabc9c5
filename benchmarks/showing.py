"""Is a lesson better after a showing? In a sparse task, where only a delivery pays: python benchmarks/showing.py

Carry, one network, is taught by the lesson alone, by imitation of one careful drive alone, and by that and then the
lesson, at equal ticks: it has a generation less for what was driven. The teacher is a rule over skills of
examples/collect, at half their speed. Figures are deliveries in a run, means on common fresh layouts. `--seeds 20`
makes a table to be trusted.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

MIND = """use "collect.mind"
master Carry

skill Still is rule
  drives left_wheel at 0.5
  drives right_wheel at 0.5

skill Teacher is rule
  reads holding
  influences GoToObject at 1 - holding
  influences GoToDropZone at holding
  influences Still at 1
  influences Grab at 1

skill Carry is mlp hidden 2
  reads object_bearing
  reads drop_zone_bearing
  reads object_in_reach
  reads in_drop_zone
  reads holding
  drives left_wheel
  drives right_wheel
  influences Grab at 1

task Carry in plain
  contains object is item size 1
  contains drop_zone is zone size 10
  lasts 3000 ticks
  rewards 1 on delivery of object
  counts delivery of object

curriculum Carrying is genetic population 100 octaves 2
  teaches Carry on Carry for {generations} generations
"""


def mindc(folder: Path, *words: object) -> str:
    """The output of a command, whatever it ends with."""
    done = subprocess.run(
        [Path(sys.executable).with_name("mindc"), *map(str, words)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode > 1:
        raise SystemExit(done.stderr)
    return done.stdout


def deliveries(folder: Path) -> float:
    """The mean of 200 fresh layouts, which are the same for all."""
    found = json.loads(mindc(folder, "bench", "carry.mind", "--task", "Carry", "--runs", 200, "--seed", 99, "--json"))
    return float(next(iter(found["by_event"].values()))["mean"]) if found["by_event"] else 0.0


def taught(home: Path, seed: int, shown: bool, lesson: bool, generations: int) -> float:
    """The deliveries of Carry after a showing, a lesson, or one and then the other."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "collect"
        shutil.copytree(home, folder)
        (folder / "carry.mind").write_text(MIND.format(generations=generations - shown))
        if shown:
            drive = ("--task", "Carry", "--master", "Teacher", "--seed", seed, "--record", "drive.rec")
            mindc(folder, "run", "carry.mind", *drive)
            mindc(folder, "imitate", "carry.mind", "Carry", "drive.rec", "--seed", seed)
        if lesson:
            mindc(folder, "train", "carry.mind", "Carry", "--seed", seed, "--workers", 1)
        return deliveries(folder) if (folder / "carry.lock").exists() else 0.0


def main() -> None:
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--generations", type=int, default=30)
    asked = parser.parse_args()
    home = Path(__file__).parents[1] / "examples" / "collect"
    ways = {"lesson alone": (False, True), "showing alone": (True, False), "showing, then lesson": (True, True)}
    found: dict[str, list[float]] = {way: [] for way in ways}
    for seed in range(1, asked.seeds + 1):
        for way, how in ways.items():
            found[way].append(taught(home, seed, *how, asked.generations))
        print(seed, *(f"{way} {values[-1]:.2f}" for way, values in found.items()), flush=True)
    for way, values in found.items():
        error = np.std(values, ddof=1) / np.sqrt(len(values)) if len(values) > 1 else 0.0
        print(f"{way:22}{np.mean(values):6.2f} ± {error:.2f}   {min(values):.2f} to {max(values):.2f}")


if __name__ == "__main__":
    main()
