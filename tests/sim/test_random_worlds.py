"""Any world in the lanes: tick by tick what plain Python, the engine and pymunk say; the same in any company."""

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from mindrun.engine import Engine
from mindrun.functions import Mlp
from mindrun.graph import Graph
from mindrun.sensors import Physical
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace
from mindrun.weights import genes

from tests.hierarchies import SCALES
from tests.sim.plain_world import PlainWorld
from tests.sim.test_rollout import same
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]
Weights = dict[str, np.ndarray]


def weights_for(graph: Graph, scale: float, rng: np.random.Generator) -> Weights:
    return {s.name: (scale * rng.uniform(-0.7, 1, genes(s))).astype(np.float32) for s in graph.skills}


@settings(max_examples=50, suppress_health_check=SLOW)
@given(random_world(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_every_tick_is_what_plain_python_says(graph: Graph, scale: float, seed: int) -> None:
    rollout = Rollout(graph, weights_for(graph, scale, np.random.default_rng(seed)), "World", graph.master)
    follow(rollout, Engine(graph, weights_for(graph, scale, np.random.default_rng(seed))), seed % 1000)


def follow(rollout: Rollout, engine: Engine, seed: int) -> None:
    """Hold a run against a plain world and the engine."""
    graph, task = rollout.graph, rollout.task
    run = trace(rollout, seed)
    plain = PlainWorld(graph, task, run, bool(rollout.tables.world[0]["battery"]))
    used = {int(row["start"]) for row in rollout.tables.sensors}
    counts = np.zeros(len(task.events), np.int64)
    cells = [memory.start for memory in graph.memories]
    known = np.array([memory.kind.start for memory in graph.memories], np.float32)
    ended = -1
    for moment in run.moments:
        assert ended < 0
        assert moment.tick == plain.t + 1
        hold_readings(plain, used, moment)
        commands = plain.act(engine.tick(moment.readings))
        hold_mind(engine, used, moment)
        assert np.array_equal(commands, moment.commands)
        assert plain.step() == tuple(moment.body)
        happened = plain.happened()
        assert happened == moment.events.astype(bool).tolist()
        assert plain.touched == moment.touching
        with np.errstate(all="ignore"):
            readings = moment.readings.copy()
            readings[cells] = known  # a reward reads what the skills have read
            plain.reward(happened, readings)
        known = moment.readings[cells]
        assert np.array_equal(plain.lines, moment.lines, equal_nan=True)
        hold_things(plain, moment)
        counts += np.array(happened, np.int64)
        ended = next((i for i, it in enumerate(happened) if it and i in task.ends), -1)
        for i in np.flatnonzero(happened):
            event(f"{type(task.events[i]).__name__} happens")
    assert moment.tick == task.ticks or ended >= 0
    jobs = run.jobs
    assert (jobs.ticks[0], jobs.ended[0], jobs.faults[0]) == (moment.tick, ended, engine.faults)
    assert np.array_equal(jobs.counts[0], counts)


def hold_readings(plain: PlainWorld, used: set[int], moment: Moment) -> None:
    """Every physical sensor that somebody reads says what may be."""
    for sensor in plain.graph.sensors:
        if isinstance(sensor.kind, Physical) and sensor.start in used:
            for k, spans in enumerate(plain.seen(sensor)):
                value = moment.readings[sensor.start + k]
                assert any(low - 3e-6 <= value <= high + 3e-6 for low, high in spans), (sensor, k, value, spans)


def hold_mind(engine: Engine, used: set[int], moment: Moment) -> None:
    """The engine sees the same, also where it computes it itself, and thinks the same."""
    rows = [s.start + k for s in engine.graph.sensors if s.start in used for k in range(s.width)]
    assert np.array_equal(engine.readings[rows], moment.readings[rows], equal_nan=True)
    assert engine.influence.tobytes() == moment.influence.tobytes()


def hold_things(plain: PlainWorld, moment: Moment) -> None:
    """What was reached or delivered moves or vanishes where it says so, and nothing else does."""
    for i, thing in enumerate(plain.things):
        if i not in plain.changed:
            assert np.array_equal(plain.places[i], moment.things[i], equal_nan=True)
        elif "moves" not in {thing.kind.reached, getattr(thing.kind, "delivered", "")}:
            assert np.isnan(moment.things[i][:2]).all(), "it has vanished"
    assert moment.held == (-1 if plain.held in plain.changed else plain.held)
    plain.places, plain.held = moment.things.copy(), moment.held
    assert plain.charge == moment.battery


@settings(max_examples=15, suppress_health_check=SLOW)
@given(random_world(most=25), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_a_result_is_the_same_in_any_company(graph: Graph, scale: float, seed: int) -> None:
    """Of its genome and its seed alone: whatever the lane, the batch, the worker and the order."""
    rng = np.random.default_rng(seed)
    weights = weights_for(graph, scale, rng)
    learners = [skill.name for skill in graph.skills if isinstance(skill.function, Mlp)][:2]

    def rollout(**options: int) -> Rollout:
        return Rollout(graph, weights, "World", graph.master, learners, **options)

    genomes = (scale * rng.uniform(-0.7, 1, (3, rollout().genome_length))).astype(np.float32)
    seeds = rng.integers(0, 2**63, 5).tolist()
    alone = rollout(lanes=1).score(genomes, seeds)
    for options in ({"lanes": 16}, {"lanes": 3, "workers": 2}):
        assert same(alone, rollout(**options).score(genomes, seeds)), options
    order = rng.permutation(3)
    assert np.array_equal(alone.total[order], rollout(lanes=5).score(genomes[order], seeds).total, equal_nan=True)
    one = list(trace(rollout(), seeds[2], genomes[1]).moments)[-1]
    assert np.array_equal(one.lines, alone.by_line[1, 2, : len(one.lines)], equal_nan=True)
    assert one.tick == alone.ticks[1, 2]


@pytest.mark.slow
@settings(max_examples=3000, suppress_health_check=SLOW)
@given(random_world(most=120), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_many_worlds(graph: Graph, scale: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    weights = weights_for(graph, scale, rng)
    follow(Rollout(graph, weights, "World", graph.master), Engine(graph, weights), seed % 1000)
