"""Agent-ticks per second per core beside a plain pymunk loop, in one run: python benchmarks/rollout.py [--json].

One agent-tick is one robot for one tick: ten rays, the hierarchy's perceptrons, physics, rewards. Both programs take
turns, round after round, so that they see the same machine; every figure is a median with its smallest and largest.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from mindrun.train.manifest import processor, versions

from benchmarks.plain_pymunk import Robot
from benchmarks.workloads import STUCK_SEED, WARMUP_TICKS, Lanes, Weights, collect, random_weights


@dataclass(frozen=True, slots=True)
class Figure:
    """Rates of several rounds, per second."""

    rates: Sequence[float]

    def __float__(self) -> float:
        return median(self.rates)

    def __str__(self) -> str:
        return f"{float(self):>12,.0f}  ({min(self.rates):,.0f} .. {max(self.rates):,.0f})"

    def plain(self) -> dict[str, float]:
        """For JSON."""
        return {"median": round(float(self)), "min": round(min(self.rates)), "max": round(max(self.rates))}


@dataclass(frozen=True, slots=True)
class Effort:
    """How long to measure."""

    rounds: int
    ticks: int  # of the lanes, in a round
    plain: int  # of the plain loop, in a round


class Plain:
    """Robots of the plain loop on the layouts of the lanes."""

    def __init__(self, graph: Graph, weights: Weights, robots: int = 4) -> None:
        rollout = Rollout(Policy(graph, weights), "Collect", graph.master, interrupt=False)
        self.robots = [Robot(graph, weights, trace(rollout, seed), seed) for seed in range(1, robots + 1)]
        self.rate(WARMUP_TICKS)

    def rate(self, ticks: int) -> float:
        """Agent-ticks per second."""
        begin = time.perf_counter()
        for robot in self.robots:
            for _ in range(ticks):
                robot.tick()
        return len(self.robots) * ticks / (time.perf_counter() - begin)


def take_turns(rounds: int, **measures: Callable[[], float]) -> dict[str, Figure]:
    """Every measure once a round."""
    rates: dict[str, list[float]] = {name: [] for name in measures}
    for _ in range(rounds):
        for name, measure in measures.items():
            rates[name].append(measure())
    return {name: Figure(found) for name, found in rates.items()}


def main_figures(graph: Graph, weights: Weights, effort: Effort) -> dict[str, Any]:
    """The whole hierarchy in its arena, beside the plain loop, on one core and on two."""
    plain, frozen = Plain(graph, weights), Lanes(graph, weights)
    own, pair = Lanes(graph, weights, graph.master), Lanes(graph, weights, graph.master, workers=2)
    found = take_turns(
        effort.rounds,
        plain_pymunk=lambda: plain.rate(effort.plain),
        own_genomes=lambda: own.rate(effort.ticks),
        all_frozen=lambda: frozen.rate(effort.ticks),
        two_workers=lambda: pair.rate(effort.ticks),
    )
    ratios = {
        "own_genomes_to_plain": float(found["own_genomes"]) / float(found["plain_pymunk"]),
        "all_frozen_to_plain": float(found["all_frozen"]) / float(found["plain_pymunk"]),
        "two_workers_to_one": float(found["two_workers"]) / float(found["own_genomes"]),
    }
    return {"figures": found, "ratios": ratios, "behaviour": frozen.behaviour()}


def worst_case(graph: Graph, effort: Effort) -> dict[str, Any]:
    """Robots that push against obstacles, so that Chipmunk steps them all the time."""
    weights = random_weights(graph, STUCK_SEED)
    plain, own = Plain(graph, weights), Lanes(graph, weights, graph.master)
    figures = {"plain_pymunk": lambda: plain.rate(effort.plain), "own_genomes": lambda: own.rate(effort.ticks)}
    found = take_turns(effort.rounds, **figures)
    ratio = float(found["own_genomes"]) / float(found["plain_pymunk"])
    return {"figures": found, "ratios": {"own_genomes_to_plain": ratio}, "behaviour": own.behaviour()}


def starts() -> dict[str, float]:
    """Seconds of a first `mindc run`, which compiles the simulator, and of later ones."""
    mind = Path(__file__).parent.parent / "examples" / "braitenberg.mind"
    program = "from mindlang.cli import main; main()"
    with tempfile.TemporaryDirectory() as cache:
        seconds = []
        for _ in range(3):
            begin = time.perf_counter()
            subprocess.run(
                [sys.executable, "-c", program, "run", str(mind), "--seed", "1", "--json"],
                check=True, capture_output=True, env=os.environ | {"NUMBA_CACHE_DIR": cache},
            )  # fmt: skip
            seconds.append(time.perf_counter() - begin)
    return {"first": seconds[0], "later": min(seconds[1:])}


def machine() -> str:
    """What this was measured on."""
    known = versions()
    return f"{processor()}, {os.cpu_count()} cores, " + ", ".join(f"{name} {known[name]}" for name in sorted(known))


def show_case(title: str, case: dict[str, Any]) -> None:
    """Print a workload's rates and ratios, and what its robots do."""
    print(title + ": {skills_awake:.1f} skills awake, {moving:.0%} moving, {in_contact:.0%} in contact".format(
        **case["behaviour"]))  # fmt: skip
    for name, figure in case["figures"].items():
        print(f"  {name:<16}{figure}")
    for name, ratio in case["ratios"].items():
        print(f"  {name:<24}{ratio:8.2f}")


def show(found: dict[str, Any]) -> None:
    """Print for reading."""
    print(found["machine"], f"load {found['load']:.1f} before it began", sep="\n")
    print("agent-ticks per second, median (smallest .. largest)")
    show_case(f"Collect with {found['weights']} weights", found["collect"])
    show_case("Collect with robots that are stuck", found["worst_case"])
    if "starts" in found:
        print(f"first start {found['starts']['first']:.1f} s, later {found['starts']['later']:.2f} s")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--quick", action="store_true", help="only the main figures, fewer rounds")
    options = parser.parse_args()
    effort = Effort(5, 1500, 150) if options.quick else Effort(9, 3000, 500)
    graph, weights, origin = collect()
    found: dict[str, Any] = {"machine": machine(), "load": os.getloadavg()[0], "weights": origin}
    found |= {"collect": main_figures(graph, weights, effort), "worst_case": worst_case(graph, effort)}
    if not options.quick:
        found["starts"] = starts()
    if options.json:
        print(json.dumps(found, default=Figure.plain))
    else:
        show(found)


if __name__ == "__main__":
    main()
