"""How much slower a world is with five items of a name than with one, by what senses and rewards them.

    python benchmarks/five.py [rounds]

One skill with an eye of five rays, a light and a distance sensor, or some of them, or a sine alone; it says what the
claw does, while the wheels drive a circle, or to the nearest item. The reward is progress, or to reach one, which
stays, or moves. All in one thread, in turns, by the processor's time; the ratios are medians over rounds of pairs.
"""

import sys
from time import process_time

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

RUN_TICKS, RUN_COUNT, ROUND_COUNT = 10_000, 256, 5
MIND = """
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor eye is eye of red at -60 -30 0 30 60 deg range 30
sensor light is light of red
sensor distance is distance of red
sensor bearing is bearing of red
sensor beat is sine period 7 s
skill Go is mlp hidden 2
  reads SENSORS
  drives claw
  drives left_wheel at LEFT
  drives right_wheel at RIGHT
task Go in arena size 100
  contains red is item THING
  lasts TICKS ticks
  rewards REWARD
"""
ALL_SENSORS = "eye light distance"
CIRCLE_COMMANDS, THERE_COMMANDS = ("0.75", "0.55"), ("0.8 + 2 * (bearing - 0.5)", "0.8 - 2 * (bearing - 0.5)")
PROGRESS, REACH = "progress toward red per tick", "10 on reach of red"
WORLDS = {
    "no sensor of them": ("beat", "", PROGRESS),
    "an eye": ("eye", "", PROGRESS),
    "a light": ("light", "", PROGRESS),
    "a distance": ("distance", "", PROGRESS),
    "eye, light, distance": (ALL_SENSORS, "", PROGRESS),
    "the three, reach is paid": (ALL_SENSORS, "", REACH),
    "the three, reached moves": (ALL_SENSORS, "reached moves", REACH),
    "the three, driving there": (f"{ALL_SENSORS} bearing", "reached moves", REACH),
    "no sensor, reach is paid": ("beat", "", REACH),
    "no sensor, reached moves": ("beat", "reached moves", REACH),
}


def world(sensors: str, outcome: str, reward: str, count: int) -> Rollout:
    """A world with so many items."""
    reads = "\n  reads ".join(sensors.split())
    left, right = THERE_COMMANDS if "bearing" in sensors else CIRCLE_COMMANDS
    text = MIND.replace("SENSORS", reads).replace("LEFT", left).replace("RIGHT", right)
    text = text.replace("THING", f"count {count} {outcome}").replace("REWARD", reward)
    graph: Graph | None = compile_source(Source("five.mind", text.replace("TICKS", str(RUN_TICKS)))).graph
    assert graph
    return Rollout(Policy(graph, {}), "Go", "Go", ["Go"], workers=1)


def rate(rollout: Rollout) -> float:
    """Agent-ticks per second in one thread."""
    genome = np.zeros((1, rollout.genome_length), np.float32)
    begun = process_time()
    ticks = rollout.score(genome, range(RUN_COUNT)).ticks.sum()
    return float(ticks) / (process_time() - begun)


def main(rounds: int) -> None:
    """Medians over so many rounds of turns."""
    pairs = {name: (world(*said, 1), world(*said, 5)) for name, said in WORLDS.items()}
    pairs["no sensor of them"][0].compile()
    rows = [[[rate(rollout) for rollout in pair] for pair in pairs.values()] for _ in range(rounds)]
    found = np.array(rows)
    middle, ratios = np.median(found, axis=0), np.median(found[..., 1] / found[..., 0], axis=0)
    print(f"{'':28}{'one item':>12} {'five items':>12}   five / one")
    for name, (one, five), ratio in zip(pairs, middle, ratios, strict=True):
        print(f"{name:28}{one:12,.0f} {five:12,.0f}   {ratio:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else ROUND_COUNT)
