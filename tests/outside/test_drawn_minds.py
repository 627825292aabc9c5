"""Drawn minds in drawn environments: the lanes do what plain Python does, to the bit, however many they are."""

from random import Random

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.sim.outside.rollout import EnvironmentRollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from tests.draws import cases
from tests.outside import drawn_worlds
from tests.outside.drawn import environment_mind
from tests.outside.plain_outside import PlainOutside
from tests.sim.varied import as_drawn, stuck

SEEDS = st.integers(0, (1 << 64) - 1)


def graph_of(number: int) -> Graph:
    """A drawn mind, which its environment fits."""
    drawn_worlds.register()
    found = compile_source(Source("drawn.mind", environment_mind(Random(number))))
    assert found.graph is not None, [(each.message, each.hint, each.span.text) for each in found.diagnostics]
    return found.graph


def rollout_of(graph: Graph, lanes: int = 8) -> EnvironmentRollout:
    """What scores genomes of all that it can learn."""
    names = [skill.name for skill in graph.skills if genes(skill)]
    return EnvironmentRollout(Policy(graph, {}), "Go", "Go", names, lanes=lanes)


@settings(max_examples=cases(60), deadline=None)
@given(number=st.integers(0, 100_000), seed=SEEDS)
def test_a_run_is_what_plain_python_makes_of_it(number: int, seed: int) -> None:
    graph = graph_of(number)
    rollout = rollout_of(graph)
    genome = rollout.draw(1, np.random.default_rng(number))[0]
    run = trace(rollout, seed, genome)
    drawn, task = as_drawn(graph, rollout.task, run.drawn)
    failing = stuck(rollout.task, run.drawn)
    plain = PlainOutside(drawn, weights_of(rollout, genome), task, "Go", seed)
    for moment in run.moments:
        assert not plain.is_over
        for row, spans in plain.readings().items():
            value = moment.readings[row]
            assert any(np.float32(low) <= value <= np.float32(high) for low, high in spans), (row, value, spans)
        acting, happened = plain.step(moment.readings, failing)
        assert moment.acting.tolist() == [float(command) for command in acting]
        assert moment.influence.tobytes() == plain.engine.influence.tobytes()
        assert moment.events.tolist() == happened
        assert moment.lines.tolist() == [float(paid) for paid in plain.lines]
    assert plain.is_over
    jobs = run.jobs
    assert (jobs.ticks[0], jobs.ended[0], jobs.met[0]) == (plain.ticks, plain.ended, plain.met)
    assert jobs.counts[0].tolist() == plain.counts


@settings(max_examples=cases(20), deadline=None)
@given(
    number=st.integers(0, 100_000),
    lanes=st.integers(1, 9),
    seeds=st.lists(SEEDS, min_size=1, max_size=5, unique=True),
)
def test_lanes_change_nothing(number: int, lanes: int, seeds: list[int]) -> None:
    graph = graph_of(number)
    one, several = rollout_of(graph, 1), rollout_of(graph, lanes)
    genomes = one.draw(3, np.random.default_rng(number))
    first, second = one.score(genomes, seeds), several.score(genomes[::-1], seeds[::-1])
    for name in ("total", "by_line", "by_event", "ticks", "ended_by", "met", "faults"):
        ours, theirs = getattr(first, name), getattr(second, name)[::-1, ::-1]
        assert np.array_equal(ours, theirs, equal_nan=True), name


def weights_of(rollout: EnvironmentRollout, genome: np.ndarray) -> dict[str, np.ndarray]:
    """The weights of each learner, of all of theirs one after the other."""
    found, first = {}, 0
    for skill in rollout.learners:
        last = first + skill.function.genome_length(len(skill.inputs), skill.outputs)
        found[skill.name], first = genome[first:last], last
    return found
