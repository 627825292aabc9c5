"""Time of one tick of a mind on the numpy engine, every skill under influence: python benchmarks/engine.py [--json]."""

import argparse
import json
import statistics
import time
from pathlib import Path

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes

from benchmarks.workloads import COLLECT, graph_of
from mindlang.compiler.compile import load


def engine_of(graph: Graph, rng: np.random.Generator) -> Engine:
    """An engine with positive random weights, which keep every output, and with it every influence, above zero."""
    weights = {skill.name: rng.random(genes(skill), np.float32) * np.float32(0.1) for skill in graph.skills}
    return Engine(Policy(graph, weights))


def microseconds(engine: Engine, rng: np.random.Generator, ticks: int) -> float:
    """Median time of a tick over fresh random readings."""
    taken = []
    for readings in rng.random((ticks, engine.graph.width), np.float32):
        begin = time.perf_counter_ns()
        engine.tick(readings)
        taken.append(time.perf_counter_ns() - begin)
        assert (engine.influence > 0).all()
    return statistics.median(taken) / 1000


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("mind", nargs="?", type=Path, default=COLLECT)
    parser.add_argument("--ticks", type=int, default=5000)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rng = np.random.default_rng(1)
    graph = graph_of(load(options.mind))
    taken = microseconds(engine_of(graph, rng), rng, options.ticks)
    found = {"mind": options.mind.name, "skills": len(graph.skills), "ticks": options.ticks, "microseconds": taken}
    print(json.dumps(found) if options.json else f"{options.mind.name}: {taken:.0f} µs per tick (median)")


if __name__ == "__main__":
    main()
