"""Minds to measure: the example Collect with weights under which influence flows, hierarchies of any size; and lanes.

The files are those of the checkout whose mindlang is imported.
"""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.sim.rollout import DEFAULT_LANES, Rollout, Tile
from mindrun.sim.state import Jobs
from numpy.typing import NDArray

import mindlang
from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.source import Source
from mindlang.lock.status import ReadyMind, make_ready

Weights = dict[str, NDArray[np.float32]]
# The first seed of `random_weights` under which all skills of the example are awake and nearly all robots move; and one
# under which nine robots in ten push against an obstacle: the worst case, in which Chipmunk steps nearly every robot.
LIVELY_SEED, STUCK_SEED = 21, 4
WARMUP_TICKS = 300  # ticks before the clock starts: robots leave their places, caches fill
COLLECT = Path(mindlang.__file__).parent.parent / "examples" / "collect" / "collect.mind"


def graph_of(compiled: Compiled) -> Graph:
    """The graph of a program that is right."""
    assert compiled.graph is not None, [d.message for d in compiled.diagnostics]
    return compiled.graph


def shipped(name: str) -> ReadyMind:
    """A file of the examples' folder collect/ with the weights of its locks."""
    compiled = load(COLLECT.with_name(name))
    return make_ready(graph_of(compiled), compiled.sources)


def collect() -> tuple[Graph, Weights, str]:
    """The example, its weights, and where they come from."""
    ready = shipped(COLLECT.name)
    if ready.refusals:
        return ready.policy.graph, random_weights(ready.policy.graph, LIVELY_SEED), "random"
    return ready.policy.graph, {**ready.policy.weights}, "trained"


def random_weights(graph: Graph, seed: int) -> Weights:
    """Random weights; the last layers lean up, so that influence reaches the wheels."""
    rng = np.random.default_rng(seed)
    weights = {}
    for skill in graph.skills:
        genome = rng.normal(0.0, 1.5, genes(skill))
        genome[-len(genome) // 4 :] += 0.3
        weights[skill.name] = genome.astype(np.float32)
    return weights


def with_obstacles(graph: Graph, grid: float) -> Graph:
    """The example with small obstacles on a grid of that spacing."""
    text = COLLECT.read_text(encoding="utf-8").replace("grid 20 size 4 to 8", f"grid {grid:g} size 1 to 3")
    other = graph_of(compile_source(Source("grid.mind", text)))
    return replace(graph, tasks=other.tasks)


def with_skills(count: int) -> tuple[Graph, Weights]:
    """A master over `count` − 1 skills, all under influence, that drive both wheels as the trained Avoid does."""
    lines = [
        "tick 1/60 s", "master Top", "body Robot is disc size 2 density 2 linear_damping 5 angular_damping 20",
        "actuator left_wheel is wheel side left thrust 80 neutral 0.5",
        "actuator right_wheel is wheel side right thrust 80 neutral 0.5",
        "sensor proximity is range_finder at 0 22.5 45 90 135 180 225 270 315 337.5 deg range 12",
        "sensor moving is inertial", "sensor pulse is sine period 2 s",
        "skill Top is mlp hidden 2", "  reads proximity", *(f"  influences S{i}" for i in range(1, count)),
    ]  # fmt: skip
    for i in range(1, count):
        lines += [f"skill S{i} is mlp hidden 2", *(f"  reads {name}" for name in ("proximity", "moving", "pulse"))]
        lines += ["  drives left_wheel", "  drives right_wheel"]
    lines += ["task Collect in arena size 100", "  contains rock is obstacle grid 20 size 4 to 8 jitter 1"]
    lines += ["  lasts 30000 ticks", "  rewards 0.01 * forward per tick"]
    graph = graph_of(compile_source(Source("skills.mind", "\n".join(lines) + "\n")))
    _, weights, _ = collect()
    rng = np.random.default_rng(1)
    # Positive weights keep every output, and with it every influence, above zero.
    top = {s.name: (rng.random(genes(s)) * 0.3).astype(np.float32) for s in graph.skills if s.name == "Top"}
    return graph, {s.name: weights["Avoid"] for s in graph.skills} | top


class Lanes:
    """Some tiles of lanes, one per worker, that have left their beginning behind."""

    def __init__(
        self, graph: Graph, weights: Weights, learner: str | None = None, lanes: int = DEFAULT_LANES, workers: int = 1
    ) -> None:
        self.rollout = Rollout(
            Policy(_endless(graph), weights), "Collect", graph.master, [learner] if learner else [], interrupt=False
        )
        rng, genome = np.random.default_rng(1), weights.get(learner or "", np.zeros(0, np.float32))
        genomes = genome + rng.normal(0.0, 0.02, (lanes, len(genome)))  # nearly the same behaviour
        each = np.arange(lanes)
        self.parts: list[tuple[Tile, Jobs]] = []
        for worker in range(workers):
            seeds = (1 + worker * lanes + each).astype(np.uint64)
            jobs = replace(self.rollout.jobs(genomes.astype(np.float32), seeds[:1]), seeds=seeds, seed=each)
            tile = self.rollout.tile(lanes)
            self.rollout.fill(tile, jobs)
            self.parts.append((tile, jobs))
        self.lanes = lanes
        self.rate(WARMUP_TICKS)

    def rate(self, ticks: int, clock: Callable[[], float] = time.perf_counter) -> float:
        """Agent-ticks per second of all workers together."""
        begin = clock()
        with ThreadPoolExecutor(len(self.parts)) as pool:
            working = list(pool.map(lambda part: self.rollout.advance(part[0], part[1], ticks), self.parts))
        assert working == [self.lanes] * len(self.parts), "a run ended while it was measured"
        return len(self.parts) * self.lanes * ticks / (clock() - begin)

    def behaviour(self) -> dict[str, float]:
        """What the robots do now: skills under influence, and the shares that move and that Chipmunk steps."""
        state = self.parts[0][0].state
        return {
            "skills_awake": float((state.mind.influence > 0).sum(axis=0).mean()),
            "moving": float((np.hypot(state.world.body[3], state.world.body[4]) > 0.5).mean()),
            "in_contact": float((state.contact.near > 0).mean()),
        }


def _endless(graph: Graph) -> Graph:
    return replace(graph, tasks=tuple(replace(task, ticks=10**9) for task in graph.tasks))
