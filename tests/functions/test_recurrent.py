"""Recurrent networks: the same bits in the engine and in the lanes, whoever learns and whenever they wake."""

from dataclasses import replace
from math import exp
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.functions.ctrnn import Ctrnn
from mindrun.kinds.functions.elman import Elman
from mindrun.kinds.functions.function import NetworkFunction
from mindrun.kinds.functions.gru import Gru
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.neat import Neat
from mindrun.numbers.arithmetic import sigmoid
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import Source
from mindlang.proofs.proof import prove

MIND = """
tick 1/60 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor feelers is range_finder at 0 60 -60 deg
sensor pulse is sine period 1/3 s
skill Top is rule
  reads pulse
  influences Roam at 4 * pulse - 2
  influences Turn at 1/2
skill Turn is rule
  drives left_wheel at 1
  drives right_wheel at 0.4
skill Roam is elman width 5
  reads feelers
  reads pulse
  drives left_wheel
  drives right_wheel
task World in arena size 30
  lasts 300 ticks
  ends on collision
  rewards 1 per tick when pulse > 0.5
curriculum All is genetic population 10
  teaches Roam on World under Top for 3 generations
"""


def mind(text: str = MIND) -> Graph:
    found: Compiled = compile_source(Source("roam.mind", text), Path("roam.mind"))
    assert found.graph, found.diagnostics
    return found.graph


RECURRENT = {
    "elman": MIND,
    "gru": MIND.replace("is elman", "is gru"),
    "ctrnn": MIND.replace("is elman", "is ctrnn"),
    "elman bias 1": MIND.replace("width 5", "width 5 bias 1"),
    "elman centred 1": MIND.replace("width 5", "width 5 centred 1"),
    "gru bias 1 centred 1": MIND.replace("is elman width 5", "is gru width 5 bias 1 centred 1"),
    "neat links any": MIND.replace("is elman width 5", "is neat most 5 links any"),
    "neat links any centred 1": MIND.replace("is elman width 5", "is neat most 5 links any centred 1"),
}
both = pytest.mark.parametrize("text", RECURRENT.values(), ids=RECURRENT)


@pytest.mark.parametrize("bias", [0, 1])
@pytest.mark.parametrize("function", [Mlp(hidden=2), Elman(width=5), Gru(width=5)], ids=["mlp", "elman", "gru"])
def test_outputs_begin_about_a_half(function: NetworkFunction, bias: int) -> None:
    function = replace(function, bias=bias)
    before, after = function.matrix_shapes(7, 3)[-1]
    last = function.draw(7, 3, 20, np.random.default_rng(1))[:, -before * after :].reshape(20, after, before)
    halves = last[..., bias:].sum(axis=2) / 2 + last[..., :bias].sum(axis=2)
    np.testing.assert_allclose(halves, 1 / 2, atol=1e-4)  # where all neurons say 1/2
    assert last.std() > 1


def test_neurons_with_time_constants_begin_about_a_half() -> None:
    genomes = Ctrnn(5).draw(7, 3, 400, np.random.default_rng(1))
    drive, own = genomes[:, :60].reshape(400, 5, 12), genomes[:, 60:70].reshape(400, 5, 2)
    np.testing.assert_allclose(drive.sum(axis=2) / 2 + own[..., 0], 0, atol=1e-4)  # where all that it reads is 1/2
    assert np.histogram(own[..., 1], 4, (0, 8))[0] == pytest.approx([500] * 4, rel=0.2)


def drawn(graph: Graph, seed: int, count: int = 1) -> np.ndarray:
    skill = next(skill for skill in graph.skills if skill.name == "Roam")
    rng = np.random.default_rng(seed)
    genomes = skill.function.draw(len(skill.inputs), skill.outputs, count, rng)
    return np.where(genomes == 0, rng.normal(0, 2, genomes.shape).astype(np.float32), genomes)  # all links of a neat


def follow(rollout: Rollout, engine: Engine, seed: int, genome: np.ndarray | None = None) -> int:
    """Hold a run against the engine, tick by tick; how many ticks it was."""
    ticks = 0
    for moment in trace(rollout, seed, genome).moments:
        assert np.array_equal(engine.tick(moment.readings), moment.commands)
        assert np.array_equal(engine.influence, moment.influence)
        ticks += 1
    return ticks


@both
@pytest.mark.parametrize("seed", range(4))
def test_the_lanes_remember_as_the_engine_does(text: str, seed: int) -> None:
    graph = mind(text)
    weights = {"Roam": drawn(graph, seed)[0]}
    assert follow(Rollout(Policy(graph, weights), "World", "Top"), Engine(Policy(graph, weights)), seed) > 20
    learning = Rollout(Policy(graph, {}), "World", "Top", ["Roam"])
    assert follow(learning, Engine(Policy(graph, weights)), seed, weights["Roam"]) > 20


def test_for_ten_thousand_ticks_a_ctrnn_in_the_lanes_is_that_of_the_engine() -> None:
    graph = mind(RECURRENT["ctrnn"].replace("300 ticks", "10000 ticks").replace("  ends on collision\n", ""))
    genome = drawn(graph, 1)[0]
    rollout = Rollout(Policy(graph, {}), "World", "Top", ["Roam"])
    assert follow(rollout, Engine(Policy(graph, {"Roam": genome})), 1, genome) == 10_000


@pytest.mark.parametrize("bias", ["bias 0", "bias 1", "centred 1"])
@pytest.mark.parametrize("hidden", ["mlp hidden 0", "mlp hidden 1", "mlp hidden 2", "neat most 5", "neat most 0"])
def test_the_lanes_compute_every_hidden_layer_of_a_perceptron(hidden: str, bias: str) -> None:
    graph = mind(MIND.replace("is elman width 5", f"is {hidden} {bias}"))
    weights = {"Roam": drawn(graph, 1)[0]}
    assert follow(Rollout(Policy(graph, weights), "World", "Top"), Engine(Policy(graph, weights)), 1) > 20


@both
def test_one_that_reads_nothing_sends_nothing(text: str) -> None:
    """In the lanes, too, whatever the skill before it has left in the rows of its outputs."""
    graph = mind(text)
    skills = tuple(replace(skill, inputs=()) if skill.name == "Roam" else skill for skill in graph.skills)
    graph = replace(graph, skills=skills)
    policy = Policy(graph, {})
    assert follow(Rollout(policy, "World", "Top"), Engine(policy), 1) > 20


def test_it_is_what_plain_python_says() -> None:
    graph, rng = mind(), np.random.default_rng(1)
    genome = drawn(graph, 1)[0]
    top = replace(graph, master="Roam")
    engine = Engine(Policy(top, {"Roam": genome}))
    said = [0.0] * 5
    into, out = genome[:45].reshape(5, 9), genome[45:].reshape(2, 5)
    for tick in range(50):
        readings = np.append(rng.random(3), 0).astype(np.float32)
        commands = engine.tick(readings)
        inputs = [*map(float, engine.readings), *said]
        said = [1 / (1 + exp(-sum(w * x for w, x in zip(row, inputs, strict=True)))) for row in into]
        values = [min(1.0, max(0.0, sum(w * x for w, x in zip(row, said, strict=True)))) for row in out]
        assert commands == pytest.approx(values, abs=1e-4), tick


def test_gates_are_what_plain_python_says() -> None:
    graph, rng = mind(RECURRENT["gru"]), np.random.default_rng(1)
    genome = drawn(graph, 1)[0]
    engine = Engine(Policy(replace(graph, master="Roam"), {"Roam": genome}))
    *gates, out = *genome[:135].reshape(3, 5, 9).tolist(), genome[135:].reshape(2, 5).tolist()
    said = [0.0] * 5
    for tick in range(50):
        commands = engine.tick(np.append(rng.random(3), 0).astype(np.float32))
        inputs = [*map(float, engine.readings)]
        reset, kept = (sigmoids(gate, inputs + said) for gate in gates[:2])
        new = sigmoids(gates[2], inputs + [r * s for r, s in zip(reset, said, strict=True)])
        said = [u * s + (1 - u) * c for u, s, c in zip(kept, said, new, strict=True)]
        values = [min(1.0, max(0.0, sum(w * x for w, x in zip(row, said, strict=True)))) for row in out]
        assert commands == pytest.approx(values, abs=1e-4), tick


def test_time_constants_are_what_plain_python_says() -> None:
    """The sum of straight lines between powers of two is 2^⌊g⌋·(1 + (g − ⌊g⌋)) to the last bit."""
    for gene in np.float32([-3e38, -0.1, 0, 1e-9, 0.3, 0.99999994, 1, 2.7, 3, 5.123, 7.9999995, 8, 8.1, 3e38]):
        g = min(max(gene, np.float32(0)), np.float32(8))
        ticks = np.float32(2) ** int(g) * (1 + (g - np.float32(int(g))))
        rest = np.float32([1.7, 0.4, gene, 1])  # one neuron that is driven by 1.7 of an input, and said to an output
        ready = Ctrnn(1).ready(1, 1, np.insert(rest, 1, 0), {})
        state = np.float32(0)
        for _ in range(300):
            found = ready(np.float32([1]))
            state = state + (np.float32(1.7) - state) / ticks
            assert found == sigmoid(state + rest[1:2]), gene


def test_neurons_with_time_constants_are_what_plain_python_says() -> None:
    graph, rng = mind(RECURRENT["ctrnn"]), np.random.default_rng(1)
    genome = drawn(graph, 1)[0]
    engine = Engine(Policy(replace(graph, master="Roam"), {"Roam": genome}))
    drive, own, out = (genome[:45].reshape(5, 9), genome[45:55].reshape(5, 2), genome[55:].reshape(2, 5).tolist())
    state, said = np.zeros(5), [1 / (1 + exp(-bias)) for bias in own[:, 0]]
    for tick in range(50):
        commands = engine.tick(np.append(rng.random(3), 0).astype(np.float32))
        state += (drive @ [*map(float, engine.readings), *said] - state) / np.interp(
            own[:, 1], range(9), 2.0 ** np.arange(9)
        )
        said = [1 / (1 + exp(-value)) for value in state + own[:, 0]]
        values = [min(1.0, max(0.0, sum(w * x for w, x in zip(row, said, strict=True)))) for row in out]
        assert commands == pytest.approx(values, abs=1e-4), tick


def sigmoids(matrix: list[list[float]], values: list[float]) -> list[float]:
    return [1 / (1 + exp(-sum(w * x for w, x in zip(row, values, strict=True)))) for row in matrix]


@both
def test_a_new_run_begins_with_nothing_said(text: str) -> None:
    graph = mind(text)
    engine = Engine(Policy(graph, {"Roam": drawn(graph, 2)[0]}), master="Roam")
    readings = np.random.default_rng(1).random((20, 4)).astype(np.float32)
    first = [engine.tick(row).tobytes() for row in readings]
    assert [engine.tick(row).tobytes() for row in readings] != first
    engine.reset()
    assert [engine.tick(row).tobytes() for row in readings] == first


@both
def test_a_result_depends_on_genome_and_seed_alone(text: str) -> None:
    graph = mind(text)
    genomes = drawn(graph, 3, 30)
    many = Rollout(Policy(graph, {}), "World", "Top", ["Roam"], lanes=16).score(genomes, [1, 2, 3])
    one = [
        Rollout(Policy(graph, {}), "World", "Top", ["Roam"], lanes=5).score(each[None], [1, 2, 3]) for each in genomes
    ]
    assert np.array_equal(many.total, np.concatenate([each.total for each in one]))
    assert np.array_equal(many.ticks, np.concatenate([each.ticks for each in one]))
    assert len(np.unique(many.ticks)) > 1


def test_its_width_and_its_weights() -> None:
    assert Elman().genome_length(4, 2) == (4 + 6) * 6 + 6 * 2
    assert Elman(5).genome_length(4, 2) == (4 + 5) * 5 + 5 * 2
    assert Elman().genome_length(0, 2) == Elman().genome_length(4, 0) == 0
    assert Elman().explicit(4, 2) == Elman(6)
    assert (Elman().derived, Elman(5).derived) == (("width",), ())
    assert Gru(5).genome_length(4, 2) == 3 * (4 + 5) * 5 + 5 * 2
    assert Gru().explicit(4, 2) == Gru(6)
    assert Ctrnn(5).genome_length(4, 2) == (4 + 5) * 5 + 2 * 5 + 5 * 2
    assert Elman(5, bias=1).genome_length(4, 2) == (1 + 4 + 5) * 5 + (1 + 5) * 2


def test_a_bias_is_what_an_input_of_one_adds() -> None:
    """The first column of each matrix; an input that is always 1 says the same of the first layer."""
    rng, inputs = np.random.default_rng(1), np.float32([0.3, 0.8])
    own = Mlp(hidden=1, width=3, bias=1)
    genome = own.draw(2, 2, 1, rng)[0]
    into, out = genome[:9].reshape(3, 3), genome[9:].reshape(2, 4)
    said = np.array(sigmoids(into.tolist(), [1.0, 0.3, 0.8]))
    assert own.ready(2, 2, genome, {})(inputs) == pytest.approx(out[:, 0] + out[:, 1:] @ said, abs=1e-4)


def test_a_centred_perceptron_is_one_whose_biases_make_up_for_it() -> None:
    """Each is Σ w/2 less, and that of an output 1/2 more."""
    own, inputs = Mlp(hidden=1, width=3, bias=1, centred=1), np.float32([0.3, 0.8])
    genome = own.draw(2, 2, 1, np.random.default_rng(1))[0]
    into, out = genome[:9].reshape(3, 3).copy(), genome[9:].reshape(2, 4).copy()
    into[:, 0] -= into[:, 1:].sum(axis=1) / 2
    out[:, 0] += (1 - out[:, 1:].sum(axis=1)) / 2
    plain = Mlp(hidden=1, width=3, bias=1).ready(2, 2, np.concatenate([into.ravel(), out.ravel()]), {})
    assert own.ready(2, 2, genome, {})(inputs) == pytest.approx(plain(inputs), abs=1e-4)


@pytest.mark.parametrize("function", [Mlp(3), Elman(4), Gru(4), Neat(4, "any", 0), Neat(4, "forward", 0)], ids=repr)
def test_a_centred_network_says_a_half_where_all_is_a_half(function: NetworkFunction) -> None:
    """Whatever its weights are, and however long it goes on."""
    centred = replace(function, centred=1)
    genome = np.random.default_rng(1).normal(0, 4, centred.genome_length(3, 2)).astype(np.float32)
    ready, halves = centred.ready(3, 2, genome, {}), np.full(3, 0.5, np.float32)
    assert [ready(halves).tolist() for _ in range(4)] == [[0.5, 0.5]] * 4
    sent = [ready(np.float32([0.5, 0.9, 0.5])).tolist() for _ in range(2)]
    assert sent[0] != [0.5, 0.5]
    assert (sent[0] != sent[1]) == bool(centred.state_length(3, 2))


@pytest.mark.parametrize("now", [1, 0])
def test_what_gets_a_bias_does_the_same_and_what_loses_one_does_not(now: int) -> None:
    old, new = Mlp(2, 3, bias=1 - now), Mlp(2, 4, bias=now)
    weights = old.draw(2, 2, 1, np.random.default_rng(1))[0]
    wide = old.widened(weights, (2, 2), new, (3, 2))
    if not now:
        assert wide is None
        return
    assert wide is not None
    one, other = old.ready(2, 2, weights, {}), new.ready(3, 2, wide, {})
    assert np.array_equal(one(np.float32([0.3, 0.8])), other(np.float32([0.3, 0.8, 0.9])))


def test_nothing_is_proved_of_what_remembers() -> None:
    graph = mind()
    roam = next(skill for skill in graph.skills if skill.name == "Roam")
    proof = prove(graph, {"Roam": drawn(graph, 1)[0]}, 0.01)
    assert genes(roam) == 55
    assert proof.unknown == {"Roam": "remembers what it computed"}


@pytest.mark.parametrize(("now", "inputs"), [(Elman(3), 2), (Elman(1), 4)])
def test_nothing_is_widened_by_what_has_fewer_inputs_or_remembers_less(now: Elman, inputs: int) -> None:
    old = Elman(2)
    assert old.widened(np.ones(old.genome_length(3, 2), np.float32), (3, 2), now, (inputs, 2)) is None
