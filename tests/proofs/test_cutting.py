"""Bounds made sharper: what is cut, how often, and how near to the truth the bounds come."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Edge, Graph, Program, Skill
from mindrun.graph.weights import NO_WEIGHTS, genes
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure

from mindlang.proofs import interval
from mindlang.proofs.interval import SHARP_ENOUGH, Boxes, EdgeRange, SentBounds, by_itself, halves, ranges, sway_of
from mindlang.proofs.trying import readings_to_try, sent_values
from tests.draws import cases
from tests.hierarchies import random_graph
from tests.minds import always, rule, skill

R0, R1 = (("reading", 0),), (("reading", 1),)
NOTHING = (*R0, *R0, ("-", 0))  # r − r, of which intervals say −1 to 1


def range_of(value: Program, most: int, reads: tuple[int, ...] = (0,)) -> EdgeRange:
    """What a rule sends over one edge."""
    return ranges(rule("Top", Edge("skill", 1, None, value), reads=reads), None, most)[0]


def number(x: float) -> Program:
    """A number in a program."""
    return (("number", x),)


@pytest.mark.parametrize(
    ("most", "high"), [(1, 1), (2, 0.5), (3, 0.5), (4, 0.25), (7, 0.25), (8, 0.125), (500, 1 / 256)]
)
def test_as_many_boxes_as_are_allowed(most: int, high: float) -> None:
    """Every round doubles them, and counts: 1, 3, 7, 15."""
    assert range_of(NOTHING, most) == EdgeRange(0.0, high, sure=True, seen=(0.0, 0.0))


def test_only_so_many_boxes_are_cut_in_a_round() -> None:
    """After eight rounds there are 256 boxes, after the ninth 512; then 256 of them are cut, and 256 are left."""
    assert range_of(NOTHING, 1023).high == 1 / 512
    assert range_of(NOTHING, 1024).high == 1 / 512
    assert range_of(NOTHING, 1536).high == 1 / 1024


def test_what_says_least_is_cut_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """One box at a time: three cuts leave four boxes, of which none is wider than a quarter."""
    monkeypatch.setattr(interval, "BOXES_PER_ROUND", 1)
    assert range_of(NOTHING, 4).high == 0.5
    assert range_of(NOTHING, 6).high == 0.25
    assert range_of(NOTHING, 14).high == 0.125


@pytest.mark.parametrize("at_once", [1, 2, 5])
def test_boxes_that_wait_keep_what_is_sent_in_them(monkeypatch: pytest.MonkeyPatch, at_once: int) -> None:
    """1/2 + r² − r is 1/4 to 1/2; (r·s − 3r/4 − s/4) / 2 + 1/2, from 1/8 to 1/2, is least in one corner of four."""
    monkeypatch.setattr(interval, "BOXES_PER_ROUND", at_once)
    bowl = range_of((*R0, *R0, ("*", 0), *R0, ("-", 0), *number(0.5), ("+", 0)), 3000)
    assert 0.25 - SHARP_ENOUGH <= bowl.low <= 0.25
    assert 0.5 <= bowl.high <= 0.5 + SHARP_ENOUGH
    terms = (*R0, *R1, ("*", 0), *R0, *number(0.75), ("*", 0), ("-", 0), *R1, *number(0.25), ("*", 0), ("-", 0))
    saddle = range_of((*terms, *number(0.5), ("*", 0), *number(0.5), ("+", 0)), 3000, (0, 1))
    assert 0.125 - 0.02 <= saddle.low <= 0.125
    assert 0.5 <= saddle.high <= 0.5 + 0.02


def test_a_parabola_is_as_high_as_it_is() -> None:
    """r·(1 − r) is 1/4 at most; 1/2 + r·(1 − r) − r·(1 − r) is 1/2."""
    hill = (*R0, *number(1), *R0, ("-", 0), ("*", 0))
    found = range_of(hill, 20_000)
    assert 0.25 <= found.high <= 0.25 + SHARP_ENOUGH
    assert found.low == 0
    assert found.sure
    level = range_of((*number(0.5), *hill, ("+", 0), *hill, ("-", 0)), 20_000)
    assert 0.5 - SHARP_ENOUGH <= level.low <= 0.5 <= level.high <= 0.5 + SHARP_ENOUGH


def test_always_nothing_and_always_all_are_proved_exactly() -> None:
    """Bounds that are close are not enough there: a line is dead, or fully on, or it is not."""
    less = (*R0, *number(0.0004), ("*", 0), *R0, *number(0.0005), ("*", 0), ("-", 0), *number(1e-6), ("-", 0))
    assert 0 < range_of(less, 1).high < SHARP_ENOUGH
    assert range_of(less, 20_000).is_dead
    more = (*number(1), *less, ("-", 0))
    assert 1 - SHARP_ENOUGH < range_of(more, 1).low < 1
    assert range_of(more, 20_000).low == 1


def test_close_is_close_enough() -> None:
    """0.5 + 0.0009·(r − r) is not cut at all; 0.5 + 0.0011·(r − r) is, once."""
    for factor, expected in ((0.0009, 0.0009), (0.0011, 0.00055)):
        value = (*number(0.5), *NOTHING, *number(factor), ("*", 0), ("+", 0))
        found = range_of(value, 20_000)
        assert found.high - 0.5 == pytest.approx(expected, rel=1e-3)
        assert 0.5 - found.low == pytest.approx(expected, rel=1e-3)


def test_all_edges_are_looked_at() -> None:
    """Two that are close for themselves, one that is not: what is cut for one is cut for all."""
    plain = Edge("skill", 1, None, number(0.25))
    found = ranges(rule("Top", plain, Edge("skill", 2, None, NOTHING), reads=(0,)), None, 8)
    assert [(sends.low, sends.high) for sends in found] == [(0.25, 0.25), (0, 0.125)]


def test_what_is_sure_is_sure_everywhere() -> None:
    """0.1 / (r − r² + 0.1) has no zero in its divisor, which cutting shows; 0.1 / r has."""
    divisor = (*R0, *R0, *R0, ("*", 0), ("-", 0), *number(0.1), ("+", 0))
    value = (*number(0.1), *divisor, ("/", 0))
    assert not range_of(value, 1).sure
    found = range_of(value, 20_000)
    assert found.sure
    assert 0.1 / 0.35 - SHARP_ENOUGH <= found.low <= 0.1 / 0.35
    assert not range_of((*number(0.1), *R0, ("/", 0)), 2000).sure


def test_of_python_code_nothing_is_seen() -> None:
    """Its fixed lines are; where it has none, nothing is tried."""
    edges = (Edge("skill", 1, 0), always("skill", 2, 0.25))
    taken = EdgeRange(0.0, 1.0, sure=False)
    assert ranges(Skill("Top", Procedure("a.b"), (0,), edges), None, 9) == (
        taken,
        EdgeRange(0.25, 0.25, True, (0.25, 0.25)),
    )
    assert ranges(Skill("Top", Mlp(), (0,), edges), None, 9) == (taken, EdgeRange(0.25, 0.25, True, (0.25, 0.25)))
    assert ranges(Skill("Top", Procedure("a.b"), (0,), edges[:1]), None, 9) == (taken,)


def test_nothing_is_cut_for_a_function_that_is_not_known(monkeypatch: pytest.MonkeyPatch) -> None:
    looked, sent = [], interval.sent_bounds
    monkeypatch.setattr(interval, "sent_bounds", lambda *arguments: looked.append(1) or sent(*arguments))
    ranges(Skill("Top", Procedure("a.b"), (0,), (Edge("skill", 1, 0), always("skill", 2, 0.25))), None, 99)
    assert len(looked) == 1


def test_a_line_that_is_never_a_number_was_seen_to_send_nothing() -> None:
    assert range_of((*number(1), *number(0), ("/", 0)), 9, ()) == EdgeRange(0.0, 1.0, sure=False)


def test_what_was_seen_is_clamped() -> None:
    assert range_of((*R0, *number(3), ("*", 0), *number(1), ("-", 0)), 9) == EdgeRange(0.0, 1.0, True, (0.0, 1.0))


@settings(max_examples=cases(15))
@given(random_graph(), st.integers(0, 2**32 - 1))
def test_a_skill_by_itself_sends_the_same(graph: Graph, seed: int) -> None:
    """Of readings that are numbered anew."""
    rng = np.random.default_rng(seed)
    readings = rng.random((5, graph.width), np.float32)
    for each in graph.skills:
        alone, weights = by_itself(each), rng.uniform(-1, 1, genes(each)).astype(np.float32)
        assert alone.inputs == tuple(range(len(each.inputs)))
        found = sent_values(alone, weights, readings[:, list(each.inputs)])
        assert np.array_equal(found, sent_values(each, weights, readings), equal_nan=True)


@settings(max_examples=cases(40))
@given(st.lists(st.floats(-2, 2, width=32), min_size=9, max_size=9))
def test_bounds_are_close_to_what_a_small_perceptron_sends(weights: list[float]) -> None:
    """Nothing but rounding, and what lies between readings that are tried, is left after enough cuts."""
    taught = skill("Top", Mlp(hidden=1, width=3), (0, 1), ("skill", 1))
    genome = np.array(weights, np.float32)
    found = ranges(taught, genome, 2000)[0]
    grid = np.stack(np.meshgrid(*[np.linspace(0, 1, 41, dtype=np.float32)] * 2), -1).reshape(-1, 2)
    sent = np.clip(sent_values(taught, genome, grid), 0, 1)
    assert found.seen
    assert found.low <= min(sent.min(), found.seen[0])
    assert max(sent.max(), found.seen[1]) <= found.high
    assert found.seen[0] - found.low <= 0.03
    assert found.high - found.seen[1] <= 0.03


def test_readings_that_are_tried() -> None:
    """Half of them corners, the others anywhere; the same every time."""
    found = readings_to_try(3, 101)
    assert (found.shape, found.dtype) == ((101, 3), np.float32)
    corners, inside = found[:50], found[50:]
    assert set(corners.ravel().tolist()) == {0.0, 1.0}
    assert len(np.unique(corners, axis=0)) == 8
    assert ((inside > 0) & (inside < 1)).all()
    assert np.array_equal(found, readings_to_try(3, 101))
    assert len(found) == len(np.unique(inside, axis=0)) + 50


def test_the_side_that_matters_most_is_halved() -> None:
    low = np.array([[0, 0], [0, 0.5], [0.25, 0]], np.float32)
    high = np.array([[1, 1], [0.25, 1], [0.5, 1]], np.float32)
    cut = halves(Boxes(low, high), np.array([3, 1], np.float32))
    assert cut.low.tolist() == [[0, 0], [0, 0.5], [0.25, 0], [0.5, 0], [0.125, 0.5], [0.25, 0.5]]
    assert cut.high.tolist() == [[0.5, 1], [0.125, 1], [0.5, 0.5], [1, 1], [0.25, 1], [0.5, 1]]


def test_how_much_a_reading_matters() -> None:
    """Its weights in the first layer, without sign, and how often it is named in expressions; a little in any case."""
    edges = (Edge("skill", 1, 0), Edge("skill", 2, None, NOTHING))
    taught = Skill("Top", Mlp(hidden=1, width=2), (0, 1, 2), edges)
    weights = np.array([0.5, -0.25, 0, 1, 2e9, 0, 5, 5], np.float32)
    assert sway_of(taught, weights).tolist() == pytest.approx([3.5, 1e6 + 0.25, 1e-6])
    assert sway_of(taught, None).tolist() == pytest.approx([2, 1e-6, 1e-6])
    assert sway_of(skill("Top", Procedure("a.b"), (0,), ("skill", 1)), weights).tolist() == pytest.approx([1e-6])
    assert sway_of(rule("Top", always("skill", 1, 1.0)), NO_WEIGHTS).tolist() == []


def test_how_far_a_box_reaches_beyond_what_was_seen() -> None:
    """The farthest of its edges, on either side; what is close counts for nothing, but for 0 and 1."""
    low, high = np.array([0.5, 1, 0.25], np.float32), np.array([0.5, 1, 0], np.float32)
    rows = [
        ([0.5, 1, 0.25], [0.5, 1, 0], 0),
        ([0.4995, 1, 0.25], [0.5005, 1, 0], 0),
        ([0.25, 1, 0.25], [0.5, 1, 0], 0.25),
        ([0.5, 1, 0.25], [0.75, 1, 0.125], 0.25),
        ([0.5, 0.9995, 0.25], [0.5, 1, 0], 0.0005),
        ([0.5, 1, 0.25], [0.5, 1, 0.0005], 0.0005),
        ([0.625, 1, 0.5], [0.375, 1, 0], 0),
    ]
    found = SentBounds(
        np.array([r[0] for r in rows], np.float32), np.array([r[1] for r in rows], np.float32), np.ones((7, 3), bool)
    )
    assert interval._excess(found, low, high).tolist() == pytest.approx([r[2] for r in rows], abs=1e-6)
