"""How soon the guardian brings every actuator to neutral: python benchmarks/guardian.py [--trials 30] [--json]."""

import argparse
import json
import random
import statistics
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from mindrun.robot.guardian.client import Guardian

from tests.robot.guardian.driven import PLAN, TICK
from tests.robot.guardian.scenes import HANGS, KILLS, LOSSES, hang, kill, lose, robot


def kills(folder: Path, trials: int, rng: random.Random) -> dict[str, list[float | None]]:
    """Seconds to neutral after each kill."""
    return {number.name: [kill(folder, number, rng) for _ in range(trials)] for number in KILLS}


def losses(folder: Path, trials: int, rng: random.Random) -> dict[str, list[float | None]]:
    """Seconds to neutral after the guardian itself was killed or stopped."""
    return {f"its {number.name}": [lose(folder, number, rng) for _ in range(trials)] for number in LOSSES}


def hangs(folder: Path, trials: int, rng: random.Random) -> dict[str, list[float | None]]:
    """Seconds to neutral after the beginning of each hang, of which two ticks are waited for."""
    found: dict[str, list[float | None]] = {how: [] for how in HANGS}
    with robot(folder) as controller:
        for _ in range(trials):
            for how in HANGS:
                found[how].append(hang(controller, how, rng))
    return found


def starts(trials: int) -> dict[str, list[float | None]]:
    """Seconds until the guardian is ready."""
    times: list[float | None] = []
    for _ in range(trials):
        begin = time.monotonic()
        guardian = Guardian(PLAN)
        times.append(time.monotonic() - begin)
        guardian.close()
    return {"start": times}


def summary(times: list[float | None]) -> dict[str, float]:
    """How many, how long in milliseconds, how often never."""
    known = [1e3 * time for time in times if time is not None]
    return {
        "trials": len(times),
        "median": statistics.median(known),
        "max": max(known),
        "missed": len(times) - len(known),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--trials", type=int, default=30, help="of each kind")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rng = random.Random(1)
    with tempfile.TemporaryDirectory() as name:
        scenes = [scene(Path(name), options.trials, rng) for scene in (kills, losses, hangs)]
    times = {what: found for scene in scenes for what, found in scene.items()} | starts(options.trials)
    found = {what: summary(each) for what, each in times.items()}
    if options.json:
        print(json.dumps(found))
        return
    print(f"a tick is {TICK * 1e3:g} ms")
    for what, each in found.items():
        print(
            "{:11} {trials:4} trials, median {median:5.1f} ms, max {max:5.1f} ms, {missed} missed".format(what, **each)
        )


if __name__ == "__main__":
    main()
