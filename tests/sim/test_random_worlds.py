"""Any world in the lanes: tick by tick what plain Python, the engine and pymunk say; the same in any company."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.following import follow
from tests.sim.test_rollout import same
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]
Weights = dict[str, np.ndarray]


def weights_for(graph: Graph, scale: float, rng: np.random.Generator) -> Weights:
    return {s.name: (scale * rng.uniform(-0.7, 1, genes(s))).astype(np.float32) for s in graph.skills if not s.like}


def followed(graph: Graph, weights: Weights, seed: int) -> Counter[str]:
    rollout = Rollout(Policy(graph, weights), "World", graph.master, procedures=PROCEDURES)
    return follow(rollout, Engine(Policy(graph, weights), PROCEDURES), seed % 1000)


@settings(max_examples=cases(50), suppress_health_check=SLOW)
@given(random_world(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_every_tick_is_what_plain_python_says(graph: Graph, scale: float, seed: int) -> None:
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    for happening in followed(graph, weights, seed):
        event(f"{happening} happens")


@settings(max_examples=cases(15), suppress_health_check=SLOW)
@given(random_world(most=25, team=True), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_a_result_is_the_same_in_any_company(graph: Graph, scale: float, seed: int) -> None:
    """Of its genome and its seed alone: whatever the lane, the batch, the worker and the order."""
    rng = np.random.default_rng(seed)
    weights = weights_for(graph, scale, rng)
    learners = [skill.name for skill in graph.skills if genes(skill) and not skill.like][:2]

    def rollout(**options: int) -> Rollout:
        return Rollout(Policy(graph, weights), "World", graph.master, learners, procedures=PROCEDURES, **options)

    genomes = (scale * rng.uniform(-0.7, 1, (3, rollout().genome_length))).astype(np.float32)
    seeds = rng.integers(0, 2**63, 5).tolist()
    alone = rollout(lanes=1).score(genomes, seeds)
    for options in ({"lanes": 16}, {"lanes": 3, "workers": 2}):
        assert same(alone, rollout(**options).score(genomes, seeds)), options
    order = rng.permutation(3)
    assert np.array_equal(alone.total[order], rollout(lanes=5).score(genomes[order], seeds).total, equal_nan=True)
    one = list(trace(rollout(), seeds[2], genomes[1]).moments)[-1]
    if not any(thing.kind.is_robot for thing in graph.tasks[0].things):  # else these are what one of several is paid
        assert np.array_equal(one.lines, alone.by_line[1, 2, : len(one.lines)], equal_nan=True)
    assert one.tick == alone.ticks[1, 2]


@pytest.mark.slow
@settings(max_examples=cases(3000), suppress_health_check=SLOW)
@given(random_world(most=120), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_many_worlds(graph: Graph, scale: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    followed(graph, weights_for(graph, scale, rng), seed)
