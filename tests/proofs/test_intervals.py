"""Bounds of a single skill in a box: those of its corners where they are attained; elsewhere a margin, and no more."""

from itertools import product

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mindrun.graph.graph import Edge, Program, Skill
from mindrun.graph.weights import genes
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.numbers.network import NOTHING

from mindlang.proofs.interval import (
    BOUNDS,
    SIGMOID_ERROR,
    Boxes,
    SentBounds,
    expression_bounds,
    sent_bounds,
)
from mindlang.proofs.trying import is_known, sent_values
from tests.minds import always, rule, skill

SHARES = st.floats(0, 1, width=32)
NUMBERS = st.sampled_from([0.25, 0.3, 0.5, 1.0, 2.0])
SIDES = st.tuples(SHARES, SHARES).map(sorted)


def perceptron_bounds(matrices: list[np.ndarray], low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Bounds of the outputs of a perceptron of these matrices."""
    found: np.ndarray = Mlp(len(matrices) - 1).forward(BOUNDS, matrices, np.array([low, high]), NOTHING)[0]
    return found


def box(*sides: tuple[float, float]) -> Boxes:
    """A single one."""
    low, high = zip(*sides, strict=True)
    return Boxes(np.array([low], np.float32), np.array([high], np.float32))


def corners(*sides: tuple[float, float]) -> np.ndarray:
    """The readings in the corners of a box."""
    return np.array(list(product(*sides)), np.float32)


def sending(value: Program, reads: tuple[int, ...] = (0, 1)) -> Skill:
    """A rule with one edge."""
    return rule("Top", Edge("skill", 1, None, value), reads=reads)


def range_of(found: SentBounds) -> tuple[float, float, bool]:
    """The bounds of what is sent over one edge in one box."""
    return float(found.low[0, 0]), float(found.high[0, 0]), bool(found.sure[0, 0])


@given(SIDES, SIDES, NUMBERS, NUMBERS, st.sampled_from("+-*/"), st.booleans())
@example((0.0, 0.0), (0.0, 1.0), 0.25, 1.0, "/", False)
def test_an_operator_attains_its_bounds_in_corners(
    a: tuple[float, float], b: tuple[float, float], x: float, y: float, operator: str, turned: bool
) -> None:
    """Of (r0 − x) and (r1 − y), unless the divisor can be 0; then nothing is known."""
    left, right = ((("reading", i), ("number", n), ("-", 0)) for i, n in ((0, x), (1, y)))
    value = (*left, *right, (operator, 0), *[("negate", 0)] * turned)
    with np.errstate(all="ignore"):  # as `sent_bounds` calls it
        low, high = expression_bounds(value, box(a, b))
    if operator == "/" and b[0] - y <= 0 <= b[1] - y:
        assert (low[0], high[0]) == (-np.inf, np.inf)
    else:
        found = sent_values(sending(value), np.zeros(0, np.float32), corners(a, b))
        assert (low[0], high[0]) == (found.min(), found.max())


@given(st.lists(SIDES, min_size=1, max_size=5), st.data())
def test_a_layer_attains_its_bounds_in_corners(sides: list[tuple[float, float]], data: st.DataObject) -> None:
    """Each reading goes its own way into a sum, so the least and the greatest are in a corner, to the bit."""
    weights = np.array(
        data.draw(st.lists(st.floats(-3, 3, width=32), min_size=2 * len(sides), max_size=2 * len(sides)))
    )
    taught = skill("Top", Mlp(hidden=0), tuple(range(len(sides))), ("skill", 1), ("skill", 2))
    matrix = weights.astype(np.float32).reshape(2, len(sides))
    low, high = perceptron_bounds([matrix], *(np.array([ends], np.float32) for ends in zip(*sides, strict=True)))
    found = sent_values(taught, matrix.ravel(), corners(*sides))
    assert np.array_equal(low[0], found.min(axis=0))
    assert np.array_equal(high[0], found.max(axis=0))


@given(st.lists(st.floats(-3, 3, width=32), min_size=6, max_size=6), SHARES, SHARES)
def test_the_margin_of_a_hidden_layer_is_that_of_its_sigmoids(weights: list[float], x: float, y: float) -> None:
    """In a box that is a point, what is left is DIP for each neuron, and a few roundings."""
    genome = np.array(weights, np.float32)
    low, high = perceptron_bounds(
        [genome[:4].reshape(2, 2), genome[4:].reshape(1, 2)], *[np.array([[x, y]], np.float32)] * 2
    )
    found = sent_values(
        skill("Top", Mlp(hidden=1, width=2), (0, 1), ("skill", 1)), genome, np.array([[x, y]], np.float32)
    )
    assert low[0, 0] <= found[0, 0] <= high[0, 0]
    weight = float(np.abs(genome[4:]).sum())
    assert high[0, 0] - low[0, 0] <= 2 * float(SIGMOID_ERROR) * weight + 1e-6 * weight


@pytest.mark.parametrize(("out", "expected"), [(1.0, (1.0 - SIGMOID_ERROR, 1.0)), (-1.0, (-1.0, SIGMOID_ERROR - 1.0))])
def test_a_sigmoid_stays_in_its_range(out: float, expected: tuple[float, float]) -> None:
    """However far out it is looked at, its bounds are of 0..1."""
    ends = [np.array([[x]], np.float32) for x in (1.0, 1.0)]
    low, high = perceptron_bounds([np.array([[1e30]], np.float32), np.array([[out]], np.float32)], *ends)
    assert (low[0, 0], high[0, 0]) == pytest.approx(expected, abs=1e-9)
    low, high = perceptron_bounds([np.array([[-1e30]], np.float32), np.array([[1.0]], np.float32)], *ends)
    assert (low[0, 0], high[0, 0]) == (0.0, SIGMOID_ERROR)


def test_what_may_overflow_is_not_sure() -> None:
    """0 to inf in a sum, and inf − inf in one of both signs: where both ends are numbers, it is sure."""
    whole = box((0, 1), (0, 1))
    for weights, expected in (
        ((3e38, 3e38), (0, 1, False)),
        ((-3e38, -3e38), (0, 0, False)),
        ((3e38, -3e38), (0, 1, True)),
        ((0.25, 0.5), (0, 0.75, True)),
    ):
        taught = skill("Top", Mlp(hidden=0), (0, 1), ("skill", 1))
        assert range_of(sent_bounds(taught, np.array(weights, np.float32), whole)) == expected
    less_and_more = [np.array([[3e38, 3e38, -3e38]], np.float32), *[np.ones((1, 3), np.float32)] * 2]
    with np.errstate(over="ignore"):
        low, high = perceptron_bounds(less_and_more[:1], *less_and_more[1:])
    assert (low[0, 0], high[0, 0]) == (np.inf, np.inf)  # as it is in the order of the inputs


def test_a_number_that_overflows_on_its_way_is_not_sure() -> None:
    """1 / (1 + 1e308·10·r) is a number in the engine; nothing is claimed of it."""
    huge = (("reading", 0), ("number", 1e308), ("*", 0), ("number", 10.0), ("*", 0))
    value = (("number", 1.0), ("number", 1.0), *huge, ("+", 0), ("/", 0))
    with np.errstate(all="ignore"):
        assert range_of(sent_bounds(sending(value, (0,)), None, box((0, 1)))) == (0, 1, False)
        assert range_of(sent_bounds(sending(value, (0,)), None, box((0, 0)))) == (1, 1, True)


def test_of_an_unknown_function_nothing_is_known_but_its_fixed_lines_are() -> None:
    edges = (Edge("skill", 1, 0), always("skill", 2, 0.25))
    for function, weights in ((Procedure("turning.turn"), None), (Mlp(), None)):
        found = sent_bounds(Skill("Top", function, (0,), edges), weights, box((0, 1)))
        assert (found.low.tolist(), found.high.tolist()) == ([[0, 0.25]], [[1, 0.25]])
        assert found.sure.tolist() == [[False, True]]


def test_what_is_known() -> None:
    """Rules, perceptrons with weights or none to learn; neither untaught ones nor Python code that sends something."""
    learnt = skill("Top", Mlp(), (0,), ("skill", 1))
    assert is_known(learnt, np.zeros(genes(learnt), np.float32))
    assert not is_known(learnt, None)
    assert is_known(skill("Top", Mlp(), (), ("skill", 1)), None)
    assert is_known(Skill("Top", Mlp(), (0,), (always("skill", 1, 1.0),)), None)
    assert is_known(Skill("Top", Rule(), (0,), (always("skill", 1, 1.0),)), None)
    assert is_known(Skill("Top", Procedure("a.b"), (0,), (always("skill", 1, 1.0),)), None)
    assert not is_known(skill("Top", Procedure("a.b"), (0,), ("skill", 1)), None)
    assert not is_known(skill("Top", Procedure("a.b"), (0,), ("skill", 1)), np.zeros(3, np.float32))


def test_what_is_sent_is_clamped() -> None:
    for value, expected in ((1.5, (1, 1, True)), (-0.5, (0, 0, True)), (2.5, (1, 1, True))):
        assert range_of(sent_bounds(rule("Top", always("skill", 1, value)), None, box((0, 1)))) == expected


def test_a_perceptron_that_reads_nothing_sends_nothing() -> None:
    found = sent_bounds(skill("Top", Mlp(), (), ("skill", 1)), None, box((0, 1)))
    assert range_of(found) == (0, 0, True)


def test_readings_are_those_that_a_skill_reads() -> None:
    """Two boxes of three readings, of which the skill reads the last and the first."""
    boxes = Boxes(np.array([[0, 0, 0.5], [0.25, 0, 0]], np.float32), np.array([[0.5, 1, 1], [0.25, 1, 0]], np.float32))
    found = sent_bounds(skill("Top", Mlp(hidden=0), (2, 0), ("skill", 1)), np.array([0.5, -0.25], np.float32), boxes)
    assert found.low.tolist() == [[0.125], [0]]
    assert found.high.tolist() == [[0.5], [0]]
