"""Paths and leaks, held against graphs in which every path can be listed, and against influence that really leaks."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.kinds.functions.mlp import Mlp

from mindlang.proofs.paths import MAX_COUNTED_PATHS, InfluenceEdge, InfluenceEdges, influence_edges, leaks, paths
from tests.hierarchies import random_graph
from tests.minds import always, mind, rule, skill

DELTAS = st.sampled_from([0.001, 0.01, 0.3, 1.0])


def every_path(found: InfluenceEdges, begin: int, actuator: int) -> list[list[tuple[int, InfluenceEdge | None]]]:
    """All paths from a skill to an actuator, each a list of (skill, the way it goes on by)."""
    here = [[(begin, None)]] if actuator in found.drives[begin] else []
    return here + [
        [(begin, way), *rest] for way in found.onward[begin] for rest in every_path(found, way.target, actuator)
    ]


def weight(path: list[tuple[int, InfluenceEdge | None]]) -> float:
    """How much of an influence of 1 arrives at the end of a path."""
    return float(np.prod([way.most for _, way in path if way]))


def greatest(found: InfluenceEdges, skill: int, begin: int | None = None) -> float:
    """The most influence that a skill can have: over every path from the master to it."""
    begin = found.skills[0] if begin is None else begin
    onward = (way.most * greatest(found, skill, way.target) for way in found.onward[begin])
    return float(begin == skill) + sum(onward)


def leaked(found: InfluenceEdges, path: list[tuple[int, InfluenceEdge | None]], actuator: int, delta: float) -> float:
    """The share of the command that leaks take on one path, as the definition has it."""
    total = 0.0
    for step, (here, meant) in enumerate(path):
        for way in found.onward[here]:
            if way.is_learnt and way is not meant and not delta * greatest(found, here) < way.cuts:
                below = sum(weight(other) for other in every_path(found, way.target, actuator))
                total += delta * below * weight(path[:step])
    return total / (weight(path) + total)


@given(random_graph(), DELTAS)
def test_paths_and_leaks_are_those_of_a_list_of_all(graph: Graph, delta: float) -> None:
    found, count = influence_edges(graph), len(graph.actuators)
    listed, worst = paths(found, count, 1000), leaks(found, count, delta)
    for actuator in range(count):
        all_of_them = every_path(found, found.skills[0], actuator)
        names = {tuple(graph.skills[place].name for place, _ in path) for path in all_of_them}
        assert listed[actuator].count == len(all_of_them)
        assert set(listed[actuator].first) == names
        shares = [leaked(found, path, actuator, delta) for path in all_of_them]
        leak = worst[actuator]
        assert (leak is None) == (not shares)
        if leak:
            assert leak.share == pytest.approx(max(shares))
            assert sum(level.share for level in leak.levels) == pytest.approx(leak.share)
            assert tuple(level.skill for level in leak.levels) in names
            chosen = [place for place, _ in enumerate(shares) if shares[place] == pytest.approx(leak.share)]
            ways_there = [tuple(graph.skills[place].name for place, _ in all_of_them[i]) for i in chosen]
            assert tuple(level.skill for level in leak.levels) in ways_there


@st.composite
def learnt_graph(draw: st.DrawFn) -> Graph:
    """A hierarchy in which every line is learnt, over one actuator, which the last skill drives."""
    count = draw(st.integers(2, 6))
    skills = []
    for number in range(count):
        below = draw(st.lists(st.sampled_from(range(number + 1, count)), unique=True)) if number + 1 < count else []
        drives = number + 1 == count or not below or draw(st.booleans())
        sends = skill(f"S{number}", Mlp(), (0,), *(("skill", i) for i in below), *[("actuator", 0)] * drives)
        skills.append(cutting(sends, draw(st.sampled_from([0.0, 0.0, 0.05, 0.5]))))
    return mind(*skills)


def cutting(of: Skill, below: float) -> Skill:
    """A skill each of whose influences is none below so much."""
    return replace(of, edges=tuple(replace(edge, cuts=below * (edge.to == "skill")) for edge in of.edges))


@given(learnt_graph(), DELTAS, st.randoms(use_true_random=False))
def test_no_leak_takes_more_than_the_worst_case(graph: Graph, delta: float, random: object) -> None:
    """Equations 2 and 3 where a path is meant and leaks, and where all that is off it sends what it will."""
    found = influence_edges(graph)
    worst = leaks(found, 1, delta)[0]
    assert worst
    for path in every_path(found, found.skills[0], 0)[:20]:
        on = dict(path)
        influence = np.zeros(len(graph.skills))
        influence[0] = 1
        for place in found.skills:
            for way in found.onward[place]:
                if place in on:
                    value = 1.0 if way is on[place] else delta
                else:
                    value = random.choice([0.0, 1.0, random.random()])  # type: ignore[attr-defined]
                sent = value * influence[place]
                influence[way.target] += 0.0 if sent < way.cuts else sent
        drivers = [place for place in found.skills if 0 in found.drives[place]]
        unwanted = sum(influence[place] for place in drivers if place not in on)
        assert unwanted / sum(influence[place] for place in drivers) <= worst.share + 1e-12


def test_the_fan_of_section_9() -> None:
    """0.01 into a branch that fans out 3×3 to the same motor: 0.09 / 1.09 = 8.3 %."""
    go = 14
    fan = [skill(f"Fan{i}", Mlp(), (0,), *(("skill", 5 + 3 * i + j) for j in range(3))) for i in range(3)]
    graph = mind(
        skill("Top", Mlp(), (0,), ("skill", 1), ("skill", go)),
        skill("Branch", Mlp(), (0,), *(("skill", 2 + i) for i in range(3))),
        *fan,
        *(skill(f"Leaf{i}", Mlp(), (0,), ("actuator", 0)) for i in range(9)),
        skill("Go", Mlp(), (0,), ("actuator", 0)),
    )
    found = influence_edges(graph)
    assert [place.count for place in paths(found, 2, 3)] == [10, 0]
    # A path through the fan leaks more: Branch into two fans of three and Fan into two leaves, beside Top into Go.
    leak = leaks(found, 2, 0.01)[0]
    assert leak
    assert [(level.skill, round(level.share * 1.09, 6)) for level in leak.levels] == [
        ("Top", 0.01), ("Branch", 0.06), ("Fan0", 0.02), ("Leaf0", 0.0),
    ]  # fmt: skip
    assert leak.share == pytest.approx(0.09 / 1.09)
    assert leak.worst
    assert leak.worst.skill == "Branch"
    alone = found.onward[0][1]
    assert leaked(found, [(0, alone), (go, None)], 0, 0.01) == pytest.approx(0.09 / 1.09)
    assert f"{leak.share:.1%}" == "8.3%"


@pytest.mark.parametrize(("below", "share"), [(0.0, 0.3 / 1.3), (0.005, 0.3 / 1.3), (0.05, 0.0)])
def test_a_hierarchy_ten_deep_leaks_nothing_that_is_cut(below: float, share: float) -> None:
    """Ten levels with three learnt lines beside the one that is meant, each sending 0.01: 30 leaks to one motor."""
    levels, beside = 10, 3
    others = [1 + levels + number for number in range(beside)]
    down = (
        skill(f"Level{level}", Mlp(), (0,), ("skill", level + 1), *(("skill", other) for other in others))
        for level in range(levels)
    )
    drivers = (skill(f"Drive{number}", Mlp(), (0,), ("actuator", 0)) for number in range(1 + beside))
    graph = mind(*(cutting(each, below) for each in down), *drivers)
    leak = leaks(influence_edges(graph), 1, 0.01)[0]
    assert leak
    assert leak.share == pytest.approx(share)
    assert [level.skill for level in leak.levels][-1] == "Drive0" or share == 0


def test_a_fixed_line_carries_what_it_says() -> None:
    """A path through `at 1/2` is half as strong, so a leak above it counts twice; `at` itself leaks nothing."""
    half = Skill("Half", Mlp(), (0,), (always("skill", 2, 0.5), Edge("skill", 3, 0), always("skill", 4, 0.0)))
    graph = mind(
        skill("Top", Mlp(), (0,), ("skill", 1), ("skill", 3)),
        half,
        *(rule(name, always("actuator", 0, 1.0)) for name in ("Meant", "Other", "Never")),
    )
    found = influence_edges(graph)
    assert paths(found, 1, 9)[0].first == (("Top", "Half", "Meant"), ("Top", "Half", "Other"), ("Top", "Other"))
    leak = leaks(found, 1, 0.01)[0]
    assert leak
    assert [level.skill for level in leak.levels] == ["Top", "Half", "Meant"]
    assert leak.share == pytest.approx(0.04 / 1.04)


def test_ways_without_number() -> None:
    """300 layers of two skills, each influencing both of the next: 2^300 paths."""
    layers = 300
    skills = [skill("Top", Mlp(), (0,), ("skill", 1), ("skill", 2))]
    for layer, side in product(range(layers), range(2)):
        onward = [("skill", 2 * layer + 3 + i) for i in range(2)] if layer + 1 < layers else [("actuator", 0)]
        skills.append(skill(f"S{layer}.{side}", Mlp(), (0,), *onward))
    found = influence_edges(mind(*skills))
    assert paths(found, 1, 5)[0].count == MAX_COUNTED_PATHS
    assert len(paths(found, 1, 5)[0].first) == 5
    leak = leaks(found, 1, 1e-12)[0]
    assert leak
    assert leak.share == pytest.approx(1)
    assert leak.worst
    assert leak.worst.skill == "Top"


def test_no_way_at_all() -> None:
    found = influence_edges(mind(rule("Top", always("skill", 1, 0.0)), rule("Go", always("actuator", 0, 1.0))))
    assert paths(found, 2, 5)[0].count == 0
    assert leaks(found, 2, 0.01) == [None, None]
