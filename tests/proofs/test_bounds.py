"""Bounds are sound: whatever the engine computes for readings in 0..1 lies inside, on random and shipped minds."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.engine.think import hierarchy
from mindrun.engine.think import think as really_think
from mindrun.engine.think import values as really_sent
from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.graph.policy import Policy
from mindrun.graph.scopes import influence_scopes, within_scope
from mindrun.graph.weights import Weights, genes, reachable
from mindrun.kinds.functions.mlp import Mlp
from mindrun.numbers.arithmetic import sigmoid
from mindrun.numbers.expression import evaluate

from mindlang.compiler.compile import load
from mindlang.lock.status import make_ready
from mindlang.proofs.interval import SIGMOID_ERROR
from mindlang.proofs.proof import ActuatorClaims, Proof, prove
from mindlang.proofs.reach import MIN_INFLUENCE, ProvedReach, prove_reach
from mindlang.proofs.trying import ThoughtRows, sent_values, think_rows
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES, random_graph
from tests.minds import always, mind, rule, skill

COLLECT = Path("examples/collect")
SHIPPED = ["collect", "power", "constant_skills"]
SEEDS = st.integers(0, 2**32 - 1)


def some_weights(graph: Graph, scale: float, rng: np.random.Generator) -> dict[str, Weights]:
    return {
        s.name: (scale * rng.uniform(-0.7, 1, genes(s))).astype(np.float32)
        for s in graph.skills
        if genes(s) and not s.like
    }


def in_the_box(graph: Graph, rows: int, rng: np.random.Generator) -> np.ndarray:
    """Readings in 0..1: corners, insides, and values that are nearly 0."""
    readings = rng.random((rows, graph.width), np.float32)
    readings[: rows // 3] = rng.integers(0, 2, (rows // 3, graph.width))
    readings[rows // 3 : rows // 2] *= np.float32(1e-30)
    return readings


def lies_inside(
    graph: Graph, weights: dict[str, Weights], readings: np.ndarray, proof: Proof, bounds: ProvedReach
) -> None:
    """Hold what is computed for these readings against everything that was claimed."""
    names = {s.name: place for place, s in enumerate(graph.skills)}
    for s in reachable(graph, graph.master):
        found = sent_values(s, weights.get(s.owner, np.zeros(0, np.float32)), readings)
        for value, sends in zip(found.T, bounds.edges[s.name], strict=True):
            sound = np.isfinite(value)
            assert sound.all() or not sends.sure
            value = np.clip(value[sound], 0, 1)
            assert ((sends.low <= value) & (value <= sends.high)).all()
    thoughts = thoughts_of(graph, weights, readings)
    for name, bound in bounds.influence.items():
        found = thoughts.influence[:, names[name]]
        found = found[~np.isnan(found)]
        assert ((bound.low <= found) & (found <= bound.high)).all()
        assert name not in proof.dead or not found.any()
    for required in proof.requirements:
        number = names[required.skill]
        if required.holds == "always":
            acting = readings[thoughts.influence[:, number] > 0]
            assert all(evaluate(required.promise.when, row) != 0 for row in acting)
        if required.readings is not None:
            assert thoughts_of(graph, weights, required.readings[None]).influence[0, number] > 0
            assert evaluate(required.promise.when, required.readings) == 0
    for place, claim in enumerate(proof.actuators):
        commanded(claim, thoughts.total[:, place], thoughts.command[:, place])


def thoughts_of(graph: Graph, weights: Mapping[str, Weights], readings: np.ndarray) -> ThoughtRows:
    """All influence, and of each actuator what counts for it."""
    scopes = influence_scopes(graph)
    rows = [think_rows(within_scope(graph, scopes, n), weights, readings) for n in range(len(scopes.without))]
    places = [(i, rows[scopes.of["actuator", i]]) for i in range(len(graph.actuators))]
    total, command = (
        np.stack([each[:, i] for (i, _), each in zip(places, of, strict=True)], axis=1)
        for of in ([row.total for _, row in places], [row.command for _, row in places])
    )
    return ThoughtRows(rows[0].influence, total, command)


def commanded(claim: ActuatorClaims, total: np.ndarray, command: np.ndarray) -> None:
    """Hold what an actuator was sent against what was claimed of it."""
    driven = (total > 0) & np.isfinite(command)
    assert driven.all() or claim.neutral != "never"
    assert not driven.any() or claim.neutral != "always"
    assert (total[driven] >= claim.driven.total.low).all()
    assert (total[driven] <= claim.driven.total.high).all()
    meant = driven & (total >= MIN_INFLUENCE) if claim.is_rough else driven
    low, high = claim.command
    assert driven.all() or low <= claim.actuator.kind.neutral <= high
    assert ((low <= command[meant]) & (command[meant] <= high)).all()


def looked_into(graph: Graph) -> Graph:
    """The graph with a perceptron in the place of each function of which nothing is claimed: it can do anything."""
    return replace(graph, skills=tuple(replace(s, function=Mlp(1)) if s.function.opaque else s for s in graph.skills))


@settings(max_examples=cases(60))
@given(random_graph(), st.sampled_from(SCALES), SEEDS)
def test_random_hierarchies(graph: Graph, scale: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    plain = looked_into(graph)
    weights = some_weights(plain, scale, rng)
    same = {s.name: weights[s.name] for s in graph.skills if s in plain.skills and s.name in weights}
    of_graph = some_weights(graph, scale, rng) | same
    lies_inside(plain, weights, in_the_box(graph, 400, rng), prove(graph, of_graph, 0.01), prove_reach(graph, of_graph))


@settings(max_examples=cases(60))
@given(random_graph(), st.sampled_from(SCALES), SEEDS)
def test_what_the_real_engine_does(graph: Graph, scale: float, seed: int) -> None:
    """Everything above is computed for many readings at once; here the engine itself says that it is the same."""
    rng = np.random.default_rng(seed)
    weights = some_weights(graph, scale, rng)
    bounds = prove_reach(graph, weights)
    readings = in_the_box(graph, 12, rng)
    thoughts = thoughts_of(graph, weights, readings)
    made = hierarchy(Policy(graph, weights), procedure_sources(graph, PROCEDURES), graph.master)
    actuators = len(graph.actuators)
    for row, now in enumerate(readings):
        with np.errstate(all="ignore"):
            thought = really_think(made, now)
            for ready, s in zip(made.skills, reachable(graph, graph.master), strict=True):
                for value, sends in zip(really_sent(ready, now), bounds.edges[s.name], strict=True):
                    assert value is None or not np.isfinite(value) or sends.low <= min(1, max(0, value)) <= sends.high
        if any(s.function.opaque for s in reachable(graph, graph.master)):
            continue
        below = [graph.skills.index(s) for s in reachable(graph, graph.master)]  # what of others nobody knows is NaN
        assert np.array_equal(thought.influence[below], thoughts.influence[row][below], equal_nan=True)
        driven = (thoughts.total[row] > 0) & np.isfinite(thoughts.command[row])
        assert np.array_equal(thought.driven[:actuators], driven)
        assert np.array_equal(thought.command[:actuators][driven], thoughts.command[row][driven])


def shipped(name: str) -> tuple[Graph, dict[str, Weights]]:
    compiled = load(COLLECT / f"{name}.mind")
    assert compiled.graph
    ready = make_ready(compiled.graph, compiled.sources)
    assert not ready.refusals
    return ready.policy.graph, ready.policy.weights


def sampled(name: str, rows: int) -> None:
    graph, weights = shipped(name)
    proof, bounds = prove(graph, weights, 0.01), prove_reach(graph, weights)
    rng = np.random.default_rng(7)
    for _ in range(0, rows, 10_000):
        lies_inside(graph, weights, in_the_box(graph, 10_000, rng), proof, bounds)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_minds(name: str) -> None:
    sampled(name, 20_000)


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_minds_on_a_million_readings(name: str) -> None:
    sampled(name, 1_000_000)


def test_an_example_without_influence_is_one() -> None:
    """The engine itself, on the readings that are given as an example, sends neutral."""
    graph, weights = shipped("power")
    for place, claim in enumerate(prove(graph, weights, 0.01).actuators):
        assert claim.neutral == "can be"
        assert claim.tried
        assert claim.tried.readings is not None
        with np.errstate(all="ignore"):
            thought = really_think(hierarchy(Policy(graph, weights), {}, graph.master), claim.tried.readings)
        assert not thought.driven[place]
        still = [s.name for s, own in zip(graph.skills, thought.influence, strict=True) if own > 0]
        assert set(claim.tried.still) <= set(still)


def test_dead_and_fully_on() -> None:
    """A line that is never above 0 is dead, and with it what it alone influences; one never below 1 is fully on."""
    top = skill("Top", Mlp(hidden=1, width=1), (0,), ("skill", 1), ("skill", 2))
    graph = mind(
        top,
        rule("Dead", always("skill", 3, 1.0), always("actuator", 0, 0.25)),
        rule("Full", always("actuator", 0, 0.75)),
        rule("Below", always("actuator", 1, 1.0)),
    )
    proof = prove(graph, {"Top": np.array([1.0, -2.0, 3.0], np.float32)}, 0.01)
    assert proof.dead == {"Dead": ("Top",), "Below": ("Top",)}
    assert [(edge.target, edge.range.is_dead, edge.range.low) for edge in proof.edges][:2] == [
        ("Dead", True, 0.0), ("Full", False, 1.0),
    ]  # fmt: skip
    left, right = proof.actuators
    assert (left.neutral, left.weights) == ("never", ("Top",))
    assert left.command == pytest.approx((0.75, 0.75), abs=1e-5)
    assert (right.neutral, right.command) == ("always", (0.5, 0.5))


def test_p_and_one_less_p_are_never_both_zero() -> None:
    """No single line sees to it that something has influence, and all of them together do."""
    p, less = (("reading", 0),), (("number", 1.0), ("reading", 0), ("-", 0))
    top = Skill("Top", rule("x").function, (0,), (Edge("skill", 1, None, p), Edge("skill", 2, None, less)))
    graph = mind(top, rule("A", always("actuator", 0, 1.0)), rule("B", always("actuator", 0, 0.0)))
    claim = prove(graph, {}, 0.01).actuators[0]
    assert prove_reach(graph, {}).actuators[0].total.low == 0
    assert claim.neutral == "never"
    assert 0.4 < claim.driven.total.low <= 1


def test_a_number_that_may_be_none_may_not_be_sent() -> None:
    """1 / r is no number at r = 0: then nothing is commanded, and the actuator is neutral."""
    value = (("number", 1.0), ("reading", 0), ("/", 0))
    graph = mind(rule("Top", Edge("actuator", 0, None, value), reads=(0,)))
    claim = prove(graph, {}, 0.01).actuators[0]
    assert claim.neutral == "can be"
    assert claim.tried
    assert claim.tried.readings is not None
    with np.errstate(all="ignore"):
        assert Engine(Policy(graph, {})).tick(claim.tried.readings)[0] == 0.5


def test_a_divisor_that_passes_through_zero() -> None:
    """0.1 / (r − 1/2) is −0.2 and 0.2 in the corners, and anything at all between."""
    value = (("number", 0.1), ("reading", 0), ("number", 0.5), ("-", 0), ("/", 0))
    graph = mind(rule("Top", Edge("actuator", 0, None, value), reads=(0,)))
    sends = prove_reach(graph, {}).edges["Top"][0]
    assert (sends.low, sends.high, sends.sure) == (0, 1, False)


def test_the_sigmoid_falls_less_than_the_margin() -> None:
    """Over 2^20 neighbours here and there; all of float32 was looked at once (docs/proofs.md)."""
    for begin in (-15.9, -4.0, -1.0, 0.5, 2.0, 6.0):
        first = np.float32(abs(begin)).view(np.uint32)
        arguments = (first + np.arange(1 << 20, dtype=np.uint32)).view(np.float32)
        found = sigmoid(np.sort(-arguments if begin < 0 else arguments))
        assert float((np.maximum.accumulate(found) - found).max()) < float(SIGMOID_ERROR)
        assert 0 <= found.min() <= found.max() <= 1


def averaged(value: float, weights: np.ndarray) -> Graph:
    """So many skills with this influence each that all drive one wheel at the same value."""
    top = rule("Top", *(always("skill", i + 1, float(w)) for i, w in enumerate(weights)))
    return mind(top, *(rule(f"S{i}", always("actuator", 0, value)) for i in range(len(weights))))


def test_a_mean_that_rounds_beyond_all_that_is_averaged_lies_inside() -> None:
    """What is bounded is what the engine computes in float32, not what a mean is."""
    rng = np.random.default_rng(1)
    beyond = 0
    for _ in range(150):
        graph = averaged(float(np.float32(rng.uniform(0.1, 0.9))), rng.random(int(rng.integers(2, 9)), np.float32))
        command = float(Engine(Policy(graph, {})).tick([0.0])[0])
        sent = graph.skills[1].edges[0].value[0][1]
        bound = prove_reach(graph, {}).actuators[0].command
        assert bound
        assert bound.low <= command <= bound.high
        assert bound.high - bound.low < 1e-5
        beyond += command != sent
    assert beyond > 10


def test_a_mean_of_nothing_but_ones_or_noughts_is_exact() -> None:
    for value in (0.0, 1.0):
        bound = prove_reach(averaged(value, np.full(3, 0.3, np.float32)), {}).actuators[0].command
        assert bound
        assert (bound.low, bound.high) == (value, value)
