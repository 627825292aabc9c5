"""Equations 2, 3 and 6, neutral, memory, and numbers that must not get through."""

from dataclasses import replace

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.errors import MindError, ReadingsError, WeightsError
from mindrun.graph.graph import Edge, Gate, Sensor
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.memory import Cell
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.derived import Derivative
from mindrun.kinds.sensors.sensor import Scene
from mindrun.kinds.sensors.waves import Sine
from mindrun.numbers.network import matrices

from tests.hierarchies import doubling
from tests.minds import CLAW, always, mind, rule, skill

STEER = (("actuator", 0), ("actuator", 1))


def test_equation_6() -> None:
    """Figure 15: two constant skills under full influence meet in the middle."""
    both = rule("Both", always("skill", 1, 1.0), always("skill", 2, 1.0))
    forward, backward = rule("Forward", always("actuator", 0, 1.0)), rule("Backward", always("actuator", 0, 0.0))
    engine = Engine(Policy(mind(both, forward, backward), {}))
    assert engine.tick([0.0])[0] == 0.5
    assert engine.influence.tolist() == [1.0, 1.0, 1.0]


def test_a_single_driver_acts_fully_whatever_its_influence() -> None:
    engine = Engine(Policy(mind(rule("Top", always("skill", 1, 0.001)), rule("Go", always("actuator", 0, 1.0))), {}))
    assert engine.tick([0.0]).tolist() == [1.0, 0.5]


def test_a_shared_skill_adds_up_its_influence() -> None:
    top = rule("Top", always("skill", 1, 0.5), always("skill", 2, 0.25))
    left = rule("Left", always("skill", 3, 1.0), always("actuator", 0, 0.0))
    right = rule("Right", always("skill", 3, 1.0))
    engine = Engine(Policy(mind(top, left, right, rule("Go", always("actuator", 0, 1.0))), {}))
    assert engine.tick([0.0])[0] == np.float32(0.75) / np.float32(1.25)
    assert engine.influence.tolist() == [1.0, 0.5, 0.25, 0.75]


@pytest.mark.parametrize(
    ("values", "chosen"),
    [
        ((0.2, 0.3, 0.1), 1),
        ((1.3, 1.7, 0.0), 1),  # before the clamp
        ((-2.0, -1.0, -3.0), 1),
        ((0.5, 0.5, 0.5), 0),  # of equals the first
        ((np.inf, 0.5, 0.1), 1),  # what is no number is not sent, and a fault
    ],
)
def test_one_is_chosen(values: tuple[float, ...], chosen: int) -> None:
    top = replace(rule("Top", *(always("skill", i + 1, v) for i, v in enumerate(values))), chooses=True)
    below = [rule(name, always("actuator", 0, 0.25 * i)) for i, name in enumerate("ABC")]
    engine = Engine(Policy(mind(top, *below), {}))
    assert engine.tick([0.0])[0] == 0.25 * chosen
    assert engine.influence.tolist() == [1.0, *(float(i == chosen) for i in range(3))]
    assert engine.faults == sum(map(np.isinf, values))


def test_what_is_not_sent_is_not_chosen() -> None:
    """Gates that are closed and say nothing else; where all are, nobody acts."""
    gate = Gate((("number", 0.0), ("number", 1.0), (">", 0)))
    closed, open_ = replace(always("skill", 1, 1.0), gate=gate), always("skill", 2, 0.1)
    for edges, influence in (
        ((closed, open_), [1.0, 0.0, 1.0]),
        ((closed, replace(open_, gate=gate)), [1.0, 0.0, 0.0]),
    ):
        top = replace(rule("Top", *edges), chooses=True)
        below = [rule(name, always("actuator", 0, 1.0)) for name in "AB"]
        engine = Engine(Policy(mind(top, *below), {}))
        engine.tick([0.0])
        assert (engine.influence.tolist(), engine.faults) == (influence, 0)


def test_influence_over_an_actuator_counts_for_it_alone() -> None:
    """On several levels, for the one that all of them name; a skill's own influence is all that it was sent."""
    over_left = replace(always("skill", 1, 1.0), over=(("actuator", 0),))
    over_both = replace(always("skill", 2, 1.0), over=STEER)
    top = rule("Top", over_left, always("actuator", 0, 0.0), always("actuator", 1, 0.0))
    stop = rule("Stop", always("actuator", 0, 1.0), always("actuator", 1, 1.0))
    engine = Engine(Policy(mind(top, rule("Middle", over_both), stop), {}))
    assert engine.tick([0.0]).tolist() == [0.5, 0.0]
    assert engine.influence.tolist() == [1.0, 1.0, 1.0]


def test_neutral_where_nothing_influences() -> None:
    silent = rule("Top", always("skill", 1, 0.0))
    engine = Engine(Policy(mind(silent, rule("Go", always("actuator", 0, 1.0)), actuators=(CLAW,)), {}))
    assert engine.tick([0.0]).tolist() == [0.25]
    assert engine.faults == 0


def test_a_reset_engine_is_as_it_was_before_its_first_tick() -> None:
    engine = Engine(Policy(mind(rule("Go", always("actuator", 0, 1.0))), {}))
    engine.tick([1.0])
    engine.reset()
    assert (engine.readings.tolist(), engine.influence.tolist(), engine.faults) == ([0.0], [0.0], 0)


def test_the_papers_weight_counts() -> None:
    assert sum(Mlp(2).genome_length(inputs, 2) for inputs in (1, 1, 12, 13, 13, 7)) == 1510
    assert Mlp(3).genome_length(21, 3) == 1610
    assert Mlp(2).genome_length(0, 2) == 0


def test_learning_begins_with_large_weights_and_outputs_that_lie_about_one_half() -> None:
    """The last layer's weights of an output add up to 1, so that it is 1/2 where all neurons say 1/2."""
    shape = Mlp(2).layers(12, 2)
    genomes = Mlp(2).draw(12, 2, 500, np.random.default_rng(1))
    assert (genomes.shape, genomes.dtype) == ((500, Mlp(2).genome_length(12, 2)), np.float32)
    last = np.stack([matrices(genome, shape)[-1] for genome in genomes])
    np.testing.assert_allclose(last.sum(axis=2), 1.0, atol=1e-4)
    for weights in (genomes, last):
        assert (weights.mean(), weights.std()) == (pytest.approx(0.0, abs=0.1), pytest.approx(4.0, rel=0.05))
    assert Mlp(2).draw(0, 2, 3, np.random.default_rng(1)).shape == (3, 0)


def test_memory_reads_on_the_next_tick() -> None:
    write = rule("Top", always("memory", 0, 1.0), Edge("actuator", 0, None, (("reading", 1),)), reads=(1,))
    engine = Engine(Policy(mind(write, cells=(Cell(decay=0.5, start=0.25),)), {}))
    assert [engine.tick([0.0, 9.0])[0] for _ in range(3)] == [0.25, 0.625, 0.8125]


def test_memory_decays_where_nothing_drives_it() -> None:
    read = rule("Top", Edge("actuator", 0, None, (("reading", 1),)), reads=(1,))
    engine = Engine(Policy(mind(read, cells=(Cell(decay=0.5, start=1.0),)), {}))
    assert [engine.tick([0.0, 9.0])[0] for _ in range(3)] == [1.0, 0.5, 0.25]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_reading_that_is_not_finite_never_reaches_an_actuator(bad: float) -> None:
    graph = mind(skill("Go", Mlp(1), (0,), *STEER), rule("Rest", always("actuator", 0, 1.0)))
    engine = Engine(Policy(graph, {"Go": np.ones(genes(graph.skills[0]), np.float32)}))
    assert engine.tick([bad]).tolist() == [0.5, 0.5]
    assert engine.faults == 2
    assert engine.tick([1.0]).tolist() == [1.0, 1.0]
    assert engine.faults == 2


def test_outputs_that_overflow_are_not_sent() -> None:
    graph = mind(skill("Go", Mlp(1), (0, 1), *STEER), readings=2)
    engine = Engine(Policy(graph, {"Go": np.full(genes(graph.skills[0]), 3e38, np.float32)}))
    assert engine.tick([1.0, 1.0]).tolist() == [0.5, 0.5]
    assert engine.faults == 2


@pytest.mark.parametrize("above", [0.0, 1.0])
def test_a_division_by_zero_is_not_sent(above: float) -> None:
    ratio = Edge("actuator", 0, None, (("number", above), ("reading", 0), ("/", 0)))
    engine = Engine(Policy(mind(rule("Go", ratio, always("actuator", 1, 1.0), reads=(0,))), {}))
    assert engine.tick([0.0]).tolist() == [0.5, 1.0]
    assert engine.faults == 1


def test_influence_of_zero_sends_nothing_and_is_no_fault() -> None:
    graph = mind(rule("Top", always("skill", 1, 0.0)), skill("Go", Mlp(1), (0,), *STEER))
    engine = Engine(Policy(graph, {"Go": np.ones(genes(graph.skills[1]), np.float32)}))
    engine.tick([np.nan])
    assert engine.faults == 0


def test_any_skill_can_be_the_master() -> None:
    graph = mind(rule("Top", always("actuator", 0, 0.0)), rule("Go", always("actuator", 0, 1.0)))
    assert Engine(Policy(graph, {}), master="Go").tick([0.0])[0] == 1.0
    with pytest.raises(MindError, match="there is no skill Stop"):
        Engine(Policy(graph, {}), master="Stop")


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        ({}, "skill Go has no weights"),
        ({"Go": np.ones(3, np.float32)}, "skill Go needs 12 float32 weights, not 3 of float32"),
        ({"Go": np.ones(12)}, "skill Go needs 12 float32 weights, not 12 of float64"),
        ({"Go": np.full(12, np.nan, np.float32)}, "skill Go has weights that are not finite"),
    ],
)
def test_weights_are_checked(weights: dict[str, np.ndarray], message: str) -> None:
    with pytest.raises(WeightsError, match=message):
        Engine(Policy(mind(skill("Go", Mlp(1), (0,), *STEER)), weights))


def test_readings_have_the_width_of_the_mind() -> None:
    with pytest.raises(ReadingsError, match="has 1 readings"):
        Engine(Policy(mind(rule("Go", always("actuator", 0, 1.0))), {})).tick([0.0, 1.0])


@pytest.mark.parametrize(("levels", "sent"), [(129, 1.0), (140, 1.0), (140, 0.0)])
def test_influence_that_overflows_drives_nothing(levels: int, sent: float) -> None:
    """Also where it then meets a 0: inf · 0 is no number."""
    engine = Engine(Policy(mind(*doubling(levels, (always("actuator", 0, sent),))), {}))
    assert engine.tick([0.0]).tolist() == [0.5, 0.5]
    assert engine.faults == 1


def test_influence_that_is_large_drives_as_any_other() -> None:
    engine = Engine(Policy(mind(*doubling(120, (always("actuator", 0, 0.75),))), {}))
    assert engine.tick([0.0]).tolist() == [0.75, 0.5]
    assert engine.faults == 0


@pytest.mark.parametrize(("change", "seen"), [(0.25, 0.75), (-0.25, 0.25), (0.125, 0.5), (0.0, 0.5)])
def test_a_dead_zone_ends_where_it_says(change: float, seen: float) -> None:
    """What is as far from 0.5 as the dead zone is wide is seen."""
    of = Sensor("r0", Battery(), 0, 1)
    derived = Sensor("d", Derivative("r0", range=0.5, dead_zone=0.25), 1, 1)
    graph = replace(mind(rule("Top")), tick=1.0, sensors=(of, derived))
    engine = Engine(Policy(graph, {}))
    engine.tick([0.5, 0.0])
    engine.tick([0.5 + change, 0.0])
    assert engine.readings[1] == seen


def test_a_wave_is_as_exact_after_a_year_as_in_the_first_second() -> None:
    read = Sine(period=3.0).reader(Scene(1.0, {}))
    first = [read(tick, np.zeros(1, np.float32), None) for tick in range(3)]
    for tick in (3 * 10**9, 3 * 10**12):
        assert [read(tick + k, np.zeros(1, np.float32), None) for k in range(3)] == pytest.approx(first, abs=1e-3)
    far = [read(3 * 10**6 + k, np.zeros(1, np.float32), None) for k in range(3)]
    assert far == pytest.approx(first, abs=1e-7)
