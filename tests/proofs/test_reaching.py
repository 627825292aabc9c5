"""Bounds through a hierarchy are those that are attained, where its readings go separate ways; or found by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Edge, Graph, Program, Skill
from mindrun.graph.policy import Policy
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure

from mindlang.proofs import interval, reach
from mindlang.proofs.proof import ActuatorClaims, prove
from mindlang.proofs.reach import ROUNDING_MARGIN, Bound, Driven
from mindlang.proofs.trying import think_rows
from tests.draws import cases
from tests.hierarchies import doubling
from tests.minds import CLAW, WHEELS, always, mind, rule, skill
from tests.proofs.samples import ONE_LESS_R0, R0, drives, sends

LEFT, RIGHT = 0, 1
R1 = (("reading", 1),)
ONE_LESS_R1 = (("number", 1.0), ("reading", 1), ("-", 0))


def number(x: float) -> Program:
    """A number in a program."""
    return (("number", x),)


@st.composite
def separate(draw: st.DrawFn) -> Graph:
    """Rules whose lines each send a reading of their own, or a number: more of one is never less of another."""
    count = draw(st.integers(2, 5))
    skills, width = [], 0
    for place in range(count):
        targets = [("skill", i) for i in range(place + 1, count)] + [("actuator", LEFT), ("actuator", RIGHT)]
        edges, reads = [], []
        for to, target in draw(st.lists(st.sampled_from(targets), unique=True, min_size=1, max_size=4)):
            if draw(st.booleans()):
                edges.append(Edge(to, target, None, (("reading", width),)))
                reads.append(width)
                width += 1
            else:
                edges.append(always(to, target, draw(st.sampled_from([0.0, 0.25, 0.3, 1.0]))))
        skills.append(rule(f"S{place}", *edges, reads=tuple(reads)))
    return mind(*skills, readings=width)


@settings(max_examples=cases(40))
@given(separate())
def test_influence_attains_its_bounds(graph: Graph) -> None:
    """With all readings 0, and with all of them 1: to the bit, for every skill and every actuator."""
    ends = np.stack([np.zeros(graph.width, np.float32), np.ones(graph.width, np.float32)])
    thoughts, found = think_rows(graph, {}, ends), reach.prove_reach(graph, {})
    for place, each in enumerate(graph.skills):
        low, high = thoughts.influence[:, place].tolist()
        assert found.influence.get(each.name, Bound(0, 0)) == Bound(low, high)
    for place, driven in enumerate(found.actuators):
        low, high = thoughts.total[:, place].tolist()
        assert driven.total == Bound(low, high)
        assert (driven.command is None) == (high == 0)


@settings(max_examples=cases(40))
@given(separate())
def test_a_command_is_bounded_by_what_its_drivers_send(graph: Graph) -> None:
    """And by a margin for each of them that may have influence, and two more, as docs/proofs.md has it."""
    found = reach.prove_reach(graph, {})
    for place, driven in enumerate(found.actuators):
        lines = [
            (sent.low, sent.high)
            for each in graph.skills
            if each.name in found.edges and found.influence[each.name].high > 0
            for edge, sent in zip(each.edges, found.edges[each.name], strict=True)
            if edge.to == "actuator" and edge.target == place
        ]
        if driven.command:
            margin = (len(lines) + 2) * 2.0**-22
            low, high = min(low for low, _ in lines), max(high for _, high in lines)
            assert driven.command.low == (1 if low == 1 else low * (1 - margin))
            assert driven.command.high == min(1, high * (1 + margin))
        else:
            assert not lines


def test_by_hand() -> None:
    """Top sends 1/2 to A and r0 to B; A sends B r1: B has from 0 to 3/2, and the wheel that both drive up to 2."""
    graph = mind(
        rule("Top", always("skill", 1, 0.5), sends("skill", 2, R0), reads=(0,)),
        rule("A", sends("skill", 2, (*R1, *number(2), ("*", 0))), always("actuator", LEFT, 0.25), reads=(1,)),
        rule("B", always("actuator", LEFT, 0.75), always("actuator", RIGHT, 1.0)),
        readings=2,
    )
    found = reach.prove_reach(graph, {})
    assert found.influence == {"Top": Bound(1, 1), "A": Bound(0.5, 0.5), "B": Bound(0, 1.5)}
    left, right = found.actuators
    assert left == Driven(Bound(0.5, 2), Bound(0.25 * (1 - 4 * ROUNDING_MARGIN), 0.75 * (1 + 4 * ROUNDING_MARGIN)))
    assert right == Driven(Bound(0, 1.5), Bound(1, 1))
    assert (left.is_always_driven, right.is_always_driven) == (True, False)


def test_a_margin_does_not_lead_beyond_one() -> None:
    nearly = float(np.nextafter(np.float32(1), np.float32(0)))
    found = reach.prove_reach(mind(drives("Top", nearly)), {}).actuators[LEFT]
    assert found == Driven(Bound(1, 1), Bound(nearly * (1 - 3 * ROUNDING_MARGIN), 1))


def test_what_may_be_no_number_gives_no_influence_for_certain() -> None:
    """Neither a skill nor, by its drivers' commands, an actuator; and how much it can be is as before."""
    half = (*number(0.5), *R0, ("/", 0))
    graph = mind(
        rule("Top", sends("skill", 1, half), sends("actuator", RIGHT, half), reads=(0,)),
        drives("A", 0.25),
    )
    left, right = reach.prove_reach(graph, {}).actuators
    assert left.total == right.total == Bound(0, 1)


def test_influence_that_overflows_is_not_certain() -> None:
    """2^128 and more is no number in float32; at 2^127 it still is."""
    for levels, total in ((127, Bound(2.0**127, 2.0**127)), (128, Bound(0, np.inf)), (135, Bound(0, np.inf))):
        found = reach.prove_reach(mind(*doubling(levels, (always("actuator", LEFT, 0.25),))), {}).actuators[LEFT]
        assert found.total == total
        assert found.is_always_driven == (total.high < np.inf)


@pytest.mark.parametrize(
    ("one", "every", "high"),
    [(7, 1000, 0.25), (1000, 14, 0.25), (1000, 13, 0.25), (1000, 16, 0.125), (0, 9, 1), (9, 1, 1)],
)
def test_the_boxes_are_shared_by_the_skills(monkeypatch: pytest.MonkeyPatch, one: int, every: int, high: float) -> None:
    """As many as one may have, or all may have, and one in any case; of r − r more of them know more."""
    nothing = (*R0, *R0, ("-", 0))
    top = rule("Top", sends("skill", 1, nothing), reads=(0,))
    graph = mind(top, rule("A", sends("actuator", LEFT, nothing), reads=(0,)))
    monkeypatch.setattr(reach, "MAX_SKILL_BOXES", one)
    monkeypatch.setattr(reach, "MAX_TOTAL_BOXES", every)
    found = reach.prove_reach(graph, {}).edges
    assert (found["Top"][0].high, found["A"][0].high) == (high, high)


# Of all skills in the same box.


def claim(*skills: Skill, readings: int = 1) -> ActuatorClaims:
    """What is known of the left wheel."""
    return prove(mind(*skills, readings=readings), {}, 0.01).actuators[LEFT]


def bisected(overlap: float) -> tuple[Skill, ...]:
    """r − 0.3, and 0.3 + overlap − r: never both 0, which takes the more boxes the less they overlap."""
    more = (*R0, *number(0.3), ("-", 0))
    less = (*number(0.3 + overlap), *R0, ("-", 0))
    return (
        rule("Top", sends("skill", 1, more), sends("skill", 2, less), reads=(0,)),
        drives("A", 0.25),
        drives("B", 0.5),
    )


def test_the_least_influence_of_all_boxes_is_what_is_claimed() -> None:
    """r and 1 − r: in either half of the box, one of the two is 1/2 at least."""
    found = claim(
        rule("Top", sends("skill", 1, R0), sends("skill", 2, ONE_LESS_R0), reads=(0,)), drives("A", 1), drives("B", 0)
    )
    assert found.driven.total == Bound(0.5, 2)
    assert found.neutral == "never"
    three = rule("Top", *(sends("skill", i, p) for i, p in ((1, R0), (2, ONE_LESS_R0), (3, R0))), reads=(0,))
    assert claim(three, drives("A", 1), drives("B", 0), drives("C", 0)).driven.total == Bound(0.5, 3)


def test_boxes_are_cut_while_there_may_be_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is claimed where they do not suffice: eight cuts are 17 boxes, eleven are 23."""
    for overlap, made in ((0.004, 17), (0.0005, 23)):
        for boxes, work, answer in (
            (made, 9999, "never"),
            (made - 1, 9999, "not excluded"),
            (999, 3 * made, "never"),
            (999, 3 * made - 1, "not excluded"),
        ):
            monkeypatch.setattr(reach, "MAX_BOXES", boxes)
            monkeypatch.setattr(reach, "MAX_BOX_SKILLS", work)
            found = claim(*bisected(overlap))
            assert (found.neutral, found.driven.total.low > 0) == (answer, answer == "never")


def test_so_few_boxes_are_not_begun_with(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there are so many skills that a few boxes are all, not even the first cut is tried."""
    for most, answer in ((reach.MIN_BOXES, "never"), (reach.MIN_BOXES - 1, "not excluded")):
        monkeypatch.setattr(reach, "MAX_BOX_SKILLS", 3 * most)
        assert claim(*bisected(0.5)).neutral == answer


def test_every_box_that_is_cut_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """r − r + 1e-6 is open everywhere: 1, 3, 7, 15, 31, 63 boxes are made, and then 64 are too many."""
    looked, flow = [], reach.influence_bounds
    monkeypatch.setattr(reach, "MAX_BOXES", 64)
    monkeypatch.setattr(reach, "influence_bounds", lambda *arguments: looked.append(arguments[1]) or flow(*arguments))
    nearly_nothing = (*R0, *R0, ("-", 0), *number(1e-6), ("+", 0))
    found = claim(rule("Top", sends("skill", 1, nearly_nothing), reads=(0,)), drives("A", 0.5))
    assert found.neutral == "not excluded"
    assert looked == [1, 1, 2, 4, 8, 16, 32]  # the first with each skill by itself


def test_only_what_is_open_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither what is always driven, nor what nothing drives, nor what was seen without influence."""
    looked = []
    monkeypatch.setattr(reach, "_least", lambda *arguments: looked.append(arguments[3]) or 0.0)
    graph = mind(
        rule("Top", sends("skill", 1, R0), sends("skill", 2, ONE_LESS_R0), always("actuator", RIGHT, 0.5), reads=(0,)),
        drives("A", 0.25),
        rule("B", always("actuator", LEFT, 0.5), always("actuator", 3, 0.5)),
        actuators=(*WHEELS, CLAW, CLAW),
    )
    answers = [found.neutral for found in prove(graph, {}, 0.01).actuators]
    assert answers == ["not excluded", "never", "always", "can be"]
    assert looked == [LEFT]


def test_boxes_beyond_one_round_are_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """However few are looked at at once."""
    expected = claim(*bisected(0.002))
    for at_once in (1, 2, 3):
        monkeypatch.setattr(interval, "BOXES_PER_ROUND", at_once)
        assert claim(*bisected(0.002)) == expected


def test_a_sum_that_can_be_nothing_is_never_claimed(monkeypatch: pytest.MonkeyPatch) -> None:
    """r − 0.3 and 0.3 − r are both 0 at 0.3, which nobody tries; where floats are neighbours, no more is cut."""
    looked, flow = [], reach.influence_bounds
    monkeypatch.setattr(reach, "influence_bounds", lambda *arguments: looked.append(1) or flow(*arguments))
    found = claim(*bisected(0.0))
    assert len(looked) < 100
    assert found.neutral == "not excluded"
    assert found.driven.total == Bound(0, 1)


def weighed(*lines: Edge) -> tuple[Skill, ...]:
    """Either A or B, by r1, and either of them sends C the same."""
    return (
        rule("Top", sends("skill", 1, R1), sends("skill", 2, ONE_LESS_R1), reads=(1,)),
        rule("A", lines[0], reads=(0,)),
        rule("B", lines[-1], reads=(0,)),
        drives("C", 0.5),
    )


def test_what_is_known_of_a_skill_anywhere_is_known_in_each_box(monkeypatch: pytest.MonkeyPatch) -> None:
    """0.3 − r·(1 − r) is 0.05 at least, and 0.1 / (0.1 + r − r²) always a number, which takes more than a few boxes."""
    hill = (*R0, *number(1), *R0, ("-", 0), ("*", 0))
    hollow = (*number(0.3), *hill, ("-", 0))
    divisor = (*number(0.1), *R0, *R0, *R0, ("*", 0), ("-", 0), ("+", 0))
    quotient = (*number(0.1), *divisor, ("/", 0))
    monkeypatch.setattr(reach, "MAX_BOXES", reach.MIN_BOXES)
    for program, least in ((hollow, 0.05), (quotient, 0.1 / 0.35)):
        found = claim(*weighed(sends("skill", 3, program)), readings=2)
        assert found.neutral == "never"
        assert 0.5 * (least - 2e-3) <= found.driven.total.low <= 0.5 * least


def test_what_is_known_in_a_box_is_known_though_not_anywhere() -> None:
    """0.1 / r may be no number at 0 alone, where 1 − r is 1."""
    tenth = (*number(0.1), *R0, ("/", 0))
    top = rule("Top", sends("skill", 1, tenth), sends("skill", 2, ONE_LESS_R0), reads=(0,))
    found = claim(top, drives("A", 0.25), drives("B", 0.5))
    assert found.neutral == "never"
    assert found.driven.total == Bound(float(np.float32(0.1)), 2)


def test_python_code_that_reads_nothing_has_no_box_to_cut() -> None:
    graph = mind(skill("Top", Procedure("a.b"), (), ("skill", 1)), drives("A", 0.5), readings=0)
    found = prove(graph, {}, 0.01).actuators[LEFT]
    assert (found.neutral, found.driven.total) == ("not excluded", Bound(0, 1))


def test_the_reading_that_sways_most_is_cut() -> None:
    """Of 12 readings that B alone would have cut, the one that both read is, so that 16 boxes do."""
    many = (
        *ONE_LESS_R0,
        *(part for i in range(1, 12) for part in ((("reading", i), *number(0.0), ("*", 0), ("+", 0)))),
    )
    top = rule("Top", sends("skill", 1, R0), sends("skill", 2, many), reads=tuple(range(12)))
    assert claim(top, drives("A", 0.25), drives("B", 0.5), readings=12).driven.total == Bound(0.5, 2)


def test_a_joint_claim_rests_on_all_weights_on_the_way() -> None:
    """Also on those of a skill that sends anything from 0 to 1 over either line: 2s − 1 and 2 − 2s, s from 1/2 to 1."""
    graph = mind(
        skill("Top", Mlp(hidden=1, width=2), (0,), ("skill", 1), ("skill", 2)),
        rule("A", always("actuator", LEFT, 0.25)),
        rule("B", always("actuator", LEFT, 0.5), always("actuator", RIGHT, 0.5)),
    )
    proof = prove(graph, {"Top": np.array([0, 30, -2, 2, 4, -2], np.float32)}, 0.01)
    assert [(edge.range.low, edge.range.high, edge.weights) for edge in proof.edges] == [(0, 1, ()), (0, 1, ())]
    left, right = proof.actuators
    assert (left.neutral, left.weights) == ("never", ("Top",))
    assert 0 < left.driven.total.low <= 1
    assert (right.neutral, right.weights) == ("can be", ())


@settings(max_examples=cases(20))
@given(separate())
def test_engine_is_neutral_exactly_where_nothing_drives(graph: Graph) -> None:
    """In the corner where all readings are 0, which is the least of all."""
    with np.errstate(all="ignore"):
        commands = Engine(Policy(graph, {})).tick([0.0] * graph.width)
    for place, found in enumerate(prove(graph, {}, 0.01).actuators):
        if found.driven.total.low == 0:
            assert found.neutral in {"can be", "always"}
            assert commands[place] == 0.5
