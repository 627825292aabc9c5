"""Minds to measure: the example Collect with weights under which influence flows, and hierarchies of any size."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from mindrun.graph import Graph
from mindrun.weights import genes
from numpy.typing import NDArray

from mindlang.compile import Compiled, compile_source, load
from mindlang.lock.ready import make_ready
from mindlang.source import Source

Weights = dict[str, NDArray[np.float32]]
# The first seed of `random_weights` under which all skills of the example are awake and nearly all robots move; and one
# under which nine robots in ten push against an obstacle: the worst case, in which Chipmunk steps nearly every robot.
LIVELY, STUCK = 21, 4
COLLECT = Path(__file__).parent.parent / "examples" / "collect" / "collect.mind"


def graph_of(compiled: Compiled) -> Graph:
    """The graph of a program that is right."""
    assert compiled.graph is not None, [d.message for d in compiled.diagnostics]
    return compiled.graph


def collect() -> tuple[Graph, Weights, str]:
    """The example, its weights, and where they come from."""
    compiled = load(COLLECT)
    ready = make_ready(graph_of(compiled), compiled.sources)
    if ready.refusals:
        return ready.graph, random_weights(ready.graph, LIVELY), "random"
    return ready.graph, ready.weights, "trained"


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
    """A master over `count` − 1 perceptrons that all look around and drive both wheels, all under influence."""
    lines = [
        "tick 1/60 s", "master Top", "body Robot is disc",
        "actuator left_wheel is wheel side left neutral 0.5",
        "actuator right_wheel is wheel side right neutral 0.5",
        "sensor proximity is range_finder at 0 22.5 45 90 135 180 225 270 315 337.5 deg range 12",
        "skill Top is mlp hidden 2", "  reads proximity", *(f"  influences S{i}" for i in range(1, count)),
    ]  # fmt: skip
    for i in range(1, count):
        lines += [f"skill S{i} is mlp hidden 2", "  reads proximity", "  drives left_wheel", "  drives right_wheel"]
    lines += ["task Collect in arena size 100", "  contains rock is obstacle grid 20 size 4 to 8 jitter 1"]
    lines += ["  lasts 30000 ticks", "  rewards 0.01 * forward per tick"]
    graph = graph_of(compile_source(Source("skills.mind", "\n".join(lines) + "\n")))
    rng = np.random.default_rng(1)
    # Positive weights keep every output, and with it every influence, above zero.
    return graph, {s.name: (rng.random(genes(s)) * 0.3).astype(np.float32) for s in graph.skills}
