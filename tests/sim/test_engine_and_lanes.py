"""The numpy engine and the lanes compute the same bits, tick after tick, in a world and on random hierarchies."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph, Reward, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.events.event import Collision
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item
from mindrun.numbers.quantity import Span
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES, random_graph
from tests.sim.test_rollout import COLLECT, some_weights


def follow(graph: Graph, weights: dict[str, np.ndarray], task: str, master: str, seed: int, most: int) -> None:
    """Run a task in the lanes, and feed what they sensed to the engine: the same readings, influence and commands."""
    rollout = Rollout(Policy(graph, weights), task, master, procedures=PROCEDURES, interrupt=False)
    engine = Engine(Policy(graph, weights), PROCEDURES, master)
    read = sorted({row for skill in rollout.tables.skills for row in _rows(rollout, skill)})
    run = trace(rollout, seed)
    for moment in run.moments:
        commands = engine.tick(moment.readings)
        assert np.array_equal(engine.readings[read], moment.readings[read], equal_nan=True)  # 0 / 0 is computed, too
        assert np.array_equal(engine.influence, moment.influence, equal_nan=True)
        assert np.array_equal(commands, moment.commands)
        if moment.tick == most:
            return
    assert run.jobs.faults[0] == engine.faults


def _rows(rollout: Rollout, skill: np.void) -> list[int]:
    first = int(skill["input"])
    return [int(row) for row in rollout.tables.inputs[first : first + int(skill["inputs"])]]


@pytest.mark.parametrize("seed", range(2))
def test_collect_in_its_world(seed: int) -> None:
    graph = load(COLLECT).graph
    assert graph
    follow(graph, some_weights(graph, seed + 3), "Collect", "Collect", seed, 2000)


WORLD = Task(
    name="World",
    scene=Arena(40.0),
    things=(Thing("rock", Obstacle(Span(2.0, 4.0), grid=10.0, jitter=1.0)), Thing("object", Item(Span(1.0, 1.0)))),
    ticks=25,
    measures=(),
    events=(Collision(),),
    ends=(),
    rewards=(Reward("rewards 1 on collision", (("number", 1.0),), 0),),
    counts=(),
)


@settings(max_examples=cases(150))
@given(random_graph(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_random_hierarchies(graph: Graph, scale: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    weights = {s.name: (scale * rng.uniform(-1, 1, genes(s))).astype(np.float32) for s in graph.skills if not s.like}
    actuators = tuple(replace(a, kind=replace(a.kind, delay=0)) for a in graph.actuators)
    graph = replace(graph, tasks=(WORLD,), actuators=actuators)
    follow(graph, weights, "World", graph.master, seed % 1000, 100)
