"""What follows from bounds and from what was tried: one claim for each actuator, and what it rests on."""

import numpy as np
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.weights import genes
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure

from mindlang.proofs import trying
from mindlang.proofs.paths import Paths
from mindlang.proofs.proof import ActuatorClaims, prove
from mindlang.proofs.reach import MIN_INFLUENCE, Bound, Driven
from mindlang.proofs.recorded import Undriven, undriven
from mindlang.proofs.trying import Tried, readings_to_try, try_readings
from tests.minds import CLAW, WHEELS, always, mind, rule, skill
from tests.proofs.samples import R0, drives, sends, single

LEFT, RIGHT = 0, 1
UNTRIED, SEEN, STILL = Tried(), Tried((0.25, 0.75)), Tried(None, np.zeros(1, np.float32), ("Top",))


def claimed(driven: Driven, tried: Tried = UNTRIED) -> ActuatorClaims:
    """A claim about the claw, whose neutral is 1/4."""
    return ActuatorClaims(CLAW, Paths(1, ()), None, driven, tried, ())


@pytest.mark.parametrize(
    ("total", "command", "tried", "neutral", "sent"),
    [
        (Bound(0, 0), None, SEEN, "always", (0.25, 0.25)),
        (Bound(0.5, 1), Bound(0.5, 0.75), SEEN, "never", (0.5, 0.75)),
        (Bound(1e-40, 1), Bound(0.5, 0.75), SEEN, "never", (0.5, 0.75)),
        (Bound(0, 1), Bound(0.5, 0.75), STILL, "can be", (0.25, 0.75)),
        (Bound(0, 1), Bound(0, 0.125), STILL, "can be", (0, 0.25)),
        (Bound(0, 1), Bound(0.5, 0.75), SEEN, "not excluded", (0.25, 0.75)),
        (Bound(0, 1), Bound(0.125, 0.75), UNTRIED, "not excluded", (0.125, 0.75)),
    ],
)
def test_whether_neutral_is_sent(
    total: Bound, command: Bound | None, tried: Tried, neutral: str, sent: tuple[float, float]
) -> None:
    found = claimed(Driven(total, command), tried)
    assert (found.neutral, found.command) == (neutral, sent)


@pytest.mark.parametrize(
    ("low", "command", "rough"),
    [
        (0.0, Bound(0.25, 0.5), True),
        (MIN_INFLUENCE / 2, Bound(0.25, 0.5), True),
        (MIN_INFLUENCE, Bound(0.25, 0.5), False),
        (0.99e-30, Bound(0.25, 0.5), True),
        (1.01e-30, Bound(0.25, 0.5), False),
        (0.0, Bound(0, 1), False),
        (0.0, Bound(1, 1), False),
        (0.0, Bound(0, 0), False),
        (0.0, Bound(0, 0.5), True),
        (0.0, Bound(0.5, 1), True),
        (0.0, None, False),
    ],
)
def test_whether_rounding_may_decide(low: float, command: Bound | None, rough: bool) -> None:
    """Where influence can be so small that a product has no digits left, unless the command is 0 or 1 in any case."""
    assert claimed(Driven(Bound(low, 1), command)).is_rough == rough


def rests(graph: Graph, **weights: object) -> list[tuple[str, ...]]:
    """What the claims about the actuators rest on."""
    return [found.weights for found in prove(graph, weights, 0.01).actuators]  # type: ignore[arg-type]


def test_a_claim_rests_on_the_weights_that_narrow_what_is_sent_on_its_way() -> None:
    """A line of A is at most 1/2, one of B anything from 0 to 1; what drives is sure to be a number in any case."""
    graph = mind(
        rule("Top", always("skill", 1, 1.0), always("skill", 2, 1.0)),
        skill("A", Mlp(hidden=0), (0,), ("skill", 3), ("skill", 5)),
        skill("B", Mlp(hidden=0), (0,), ("skill", 4), ("skill", 5)),
        drives("C", 0.5),
        drives("D", 0.5, RIGHT),
        skill("E", Mlp(hidden=0), (0,), ("actuator", 2)),
        actuators=(*WHEELS, CLAW),
    )
    assert rests(graph, A=single(0.5, 1), B=single(1, 1), E=single(1)) == [("A",), (), ("E",)]
    assert rests(graph, A=single(1, 0.5), B=single(1, 0.5), E=single(1)) == [(), (), ("A", "B", "E")]
    assert rests(graph, A=single(1, 0.5), B=single(1, 0.5)) == [(), (), ("A", "B")]
    assert rests(graph, E=single(1)) == [(), (), ("E",)]


def test_a_dead_skill_rests_on_the_nearest_lines_that_send_nothing() -> None:
    """D is below A and B, of which one is dead itself and the other sends it nothing."""
    graph = mind(
        skill("Top", Mlp(hidden=0), (0,), ("skill", 1), ("skill", 2)),
        skill("A", Mlp(hidden=0), (0,), ("skill", 3)),
        skill("B", Mlp(hidden=0), (0,), ("skill", 3), ("skill", 4)),
        rule("D", always("skill", 5, 0.5)),
        drives("Used", 0.5),
        drives("E", 0.5),
    )
    weights = {"Top": single(-1, 1), "A": single(1), "B": single(-1, 1)}
    found = prove(graph, weights, 0.01)
    assert found.dead == {"A": ("Top",), "D": ("Top", "B"), "E": ("Top", "B")}
    weights["Top"], weights["A"] = single(1, 1), single(-1)
    assert prove(graph, weights, 0.01).dead == {"D": ("A", "B"), "E": ("A", "B")}


def test_what_lies_aside_and_what_is_unknown() -> None:
    graph = mind(
        skill("Top", Procedure("a.b"), (0,), ("skill", 1), ("skill", 2)),
        skill("A", Mlp(), (0,), ("actuator", LEFT)),
        rule("B", always("memory", 0, 1.0), always("actuator", LEFT, 0.5)),
        skill("Aside", Mlp(), (0,), ("actuator", RIGHT)),
        cells=(),
    )
    found = prove(graph, {}, 0.01)
    assert found.unknown == {"Top": "is Python code", "A": "has no weights that fit"}
    assert found.outside == ("Aside",)
    assert [(edge.skill, edge.target) for edge in found.edges] == [("Top", "A"), ("Top", "B")]


# What is tried.


def test_nothing_is_tried_of_what_is_not_known() -> None:
    """Of a skill below the master; what lies aside does not matter."""
    graph = mind(drives("Top", 0.5), skill("Aside", Mlp(), (0,), ("actuator", LEFT)))
    assert all(each.commands or each.readings is not None for each in try_readings(graph, {}))
    unknown = mind(rule("Top", always("skill", 1, 0.5)), skill("A", Mlp(), (0,), ("actuator", 0)))
    assert not any(each.commands or each.readings is not None for each in try_readings(unknown, {}))


@pytest.mark.parametrize(("work", "rows"), [(0, 64), (64 * 206 - 1, 64), (65 * 206, 65), (10**9, 4096)])
def test_as_many_readings_are_tried_as_there_is_time_for(monkeypatch: pytest.MonkeyPatch, work: int, rows: int) -> None:
    """64 at least and 4096 at most; a skill takes as long as 100 weights, and its own."""
    graph = mind(skill("Top", Mlp(hidden=0), (0, 1, 2), ("skill", 1), ("actuator", LEFT)), drives("A", 0.5), readings=3)
    tried = []
    monkeypatch.setattr(trying, "MAX_WEIGHT_READINGS", work)
    monkeypatch.setattr(trying, "readings_to_try", lambda *size: tried.append(size) or readings_to_try(*size))
    assert genes(graph.skills[0]) == 6
    assert try_readings(graph, {"Top": np.ones(6, np.float32)})
    assert tried == [(3, rows)]


def test_what_was_seen_of_an_actuator() -> None:
    """Its commands where something influences it, the first readings where nothing does, and who keeps still then."""
    graph = mind(
        rule("Top", sends("skill", 1, R0), always("skill", 2, 1.0), always("skill", 4, 1.0), reads=(0,)),
        rule("A", always("skill", 3, 1.0), always("actuator", RIGHT, 0.25)),
        rule("B", sends("skill", 3, R0), reads=(0,)),
        drives("C", 0.75),
        rule("Elsewhere", always("memory", 0, 1.0)),
        cells=(),
    )
    found = try_readings(graph, {})
    assert found
    left, right = found
    assert left.commands == pytest.approx((0.75, 0.75), abs=1e-6)
    assert right.commands == (0.25, 0.25)
    assert left.readings is not None
    assert right.readings is not None
    assert (left.readings.tolist(), right.readings.tolist()) == ([0], [0])
    assert (left.still, right.still) == (("B",), ("Top",))


# A run.


def test_ticks_without_influence_are_counted() -> None:
    total, commands = np.array([1, 0, 0.5, 0, 0], np.float32), np.array([0.25, 0.5, 0.75, 0.5, 0.5], np.float32)
    assert undriven(total, commands) == Undriven(3, 2, (0.25, 0.75))
    assert undriven(total[:1], commands[:1]) == Undriven(0, None, (0.25, 0.25))
    assert undriven(total[1:2], commands[1:2]) == Undriven(1, 1, (0.5, 0.5))
