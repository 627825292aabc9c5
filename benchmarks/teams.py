"""What several robots in one world cost: python benchmarks/teams.py [--robots 1 2 4 8 16].

The hierarchy of examples/collect/best.mind in so many bodies: robot-ticks of a CPU second with one object beside those
of one robot, in turns; and what each delivers and runs into in 30,000 ticks, on the same layouts, with one object for
all and with as many as robots.
"""

import argparse
import json
import time
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.lock.status import make_ready

BEST = Path(__file__).parents[1] / "examples" / "collect" / "best.mind"
TASK = """
sensor mate_bearing is bearing of mate

task Team in Rocks
  contains object is item count {objects} size 1
  contains drop_zone is zone size 10
{mates}  lasts 30000 ticks
  rewards 30 on delivery of object
  rewards 0 on collision
{hits}  counts delivery of object
"""
NO_GENOME = np.zeros((1, 0), np.float32)


def team(robots: int, objects: int) -> Rollout:
    """The rollout of so many robots and objects, compiled."""
    mates = f"  contains mate is robot count {robots - 1}\n" if robots > 1 else ""
    hits = "  rewards 0 on collision with mate\n" if robots > 1 else ""
    text = TASK.format(objects=objects, mates=mates, hits=hits)
    if robots == 1:
        text = text.replace("sensor mate_bearing is bearing of mate\n", "")
    compiled = compile_source(Source(BEST.name, BEST.read_text(encoding="utf-8") + text, BEST.parent), BEST)
    assert compiled.graph is not None, compiled.diagnostics
    policy = make_ready(compiled.graph, compiled.sources, "Deliver").policy
    rollout = Rollout(policy, "Team", "Deliver")
    rollout.compile()
    return rollout


def rates(teams: dict[int, Rollout], rounds: int = 5) -> dict[int, float]:
    """The most robot-ticks of a CPU second of each team, in turns, in runs of 2,000 ticks."""
    most = dict.fromkeys(teams, 0.0)
    for number in range(rounds):
        for robots, rollout in teams.items():
            seeds = range(100 * number, 100 * number + max(16, 256 // robots))
            begun = time.process_time()
            ticks = float(rollout.score(NO_GENOME, [*seeds], ticks=2000).ticks.sum()) * robots
            most[robots] = max(most[robots], ticks / (time.process_time() - begun))
    return most


def outcomes(rollout: Rollout, robots: int, layouts: int) -> dict[str, Any]:
    """What each robot delivers and runs into in a run, the mean and its standard error."""
    events = rollout.score(NO_GENOME, [*range(1, layouts + 1)]).by_event[0] / robots
    found = {}
    for name, each in zip(("delivered", "hits", "mates"), events.T, strict=False):
        found[name] = [float(each.mean()), float(each.std(ddof=1) / layouts**0.5)]
    return found


def main() -> None:
    """Measure, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--robots", type=int, nargs="+", default=[1, 2, 4, 8, 16])
    parser.add_argument("--layouts", type=int, default=40)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    teams = {robots: team(robots, 1) for robots in options.robots}
    speed = rates(teams)
    rows = []
    for robots, rollout in teams.items():
        for objects, runs in ((1, rollout), (robots, team(robots, robots))):
            found = outcomes(runs, robots, options.layouts)
            rows.append({"robots": robots, "objects": objects, "rate": speed[robots], **found})
            if not options.json:
                said = ", ".join(f"{name} {mean:.1f} ± {error:.1f}" for name, (mean, error) in found.items())
                share = speed[robots] / speed[min(speed)]
                rate = f"{speed[robots] / 1e6:.2f} M robot-ticks, {share:.2f}"
                print(f"{robots:2} robots, {objects:2} objects: {rate}; {said}")
    if options.json:
        print(json.dumps(rows))


if __name__ == "__main__":
    main()
