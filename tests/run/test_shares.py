"""What each path has contributed to a command: held against exact fractions over every path there is."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from math import fsum

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.engine.think import Hierarchy, hierarchy, values
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.scopes import influence_scopes
from numpy.typing import NDArray

from mindlang.attribution.shares import Shares, shares
from mindlang.run.edge_flow import EdgeFlows, Sink, edge_flows, sink_named
from tests.draws import cases
from tests.hierarchies import PROCEDURES, Case, doubling, random_case
from tests.minds import always, mind, rule

HALF_ULP = Fraction(1, 2**24)  # relative error of a float32 operation
LEAST = Fraction(1, 2**150)  # error of a quotient near 0
DOUBLES = 1e-12  # what the doubles of the shares may be off, relatively
ALL = 10_000  # paths
MOST_SKILLS = 20  # of which every path is looked at


@dataclass
class Thought:
    """A run of an engine: what it read, thought and commanded."""

    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: list[NDArray[np.float32]] = field(default_factory=list)


def thought(case: Case) -> Thought:
    """The engine's run over a case's readings."""
    engine = Engine(Policy(case.graph, case.weights), PROCEDURES)
    rows = [(engine.tick(row), engine.readings, engine.influence) for row in case.readings]
    return Thought(np.array([row[1] for row in rows]), np.array([row[2] for row in rows]), [row[0] for row in rows])


def flows_of(case: Case, run: Thought) -> EdgeFlows:
    """The flows of that run."""
    graph = case.graph
    return edge_flows(Policy(graph, case.weights), procedure_sources(graph, PROCEDURES), graph.master, run)


def sinks(flows: EdgeFlows) -> list[Sink]:
    """All that can be asked about."""
    graph = flows.graph
    named = [*(graph.skills[index] for index in flows.skills), *graph.actuators, *graph.memories]
    found = [sink_named(flows, each.name) for each in named]
    return [sink for sink in found if sink is not None]


Sent = list[list[np.float32 | None]]  # by each skill over its edges, nothing where it did not compute


def sent_values(mind: Hierarchy, run: Thought, row: int) -> Sent:
    """The values of a row. Computes each skill once, as an engine does."""
    nothing = [[None] * len(skill.edges) for skill in mind.skills]
    return [
        values(skill, run.readings[row]) if run.influence[row, skill.index] != 0 else none
        for skill, none in zip(mind.skills, nothing, strict=True)
    ]


@dataclass
class Exact:
    """One tick in fractions: what came over each edge to each target as (its skill, what it carried, the influence)."""

    graph: Graph
    came: dict[Sink, list[tuple[int, Fraction, Fraction]]] = field(default_factory=dict)

    @classmethod
    def of(cls, graph: Graph, mind: Hierarchy, sent: Sent, scope: int) -> "Exact | None":
        """The tick in a scope; None where something overflows or is no number."""
        found = cls(graph)
        sound = True
        influence = np.zeros(len(graph.skills), np.float32)
        influence[mind.master] = 1
        for skill, numbers in zip(mind.skills, sent, strict=True):
            own = influence[skill.index]
            for edge, value in zip(skill.edges, numbers, strict=True):
                if value is None or not np.isfinite(value) or own == 0:
                    continue
                carried = np.float32(min(max(value, np.float32(0)), np.float32(1))) * own
                if not np.isfinite(carried):
                    sound = False
                elif not edge.drives and scope not in edge.scopes:
                    continue
                elif edge.drives or not carried < edge.cuts:
                    kind = "skill" if not edge.drives else "actuator" if edge.to < len(graph.actuators) else "memory"
                    place = edge.to - len(graph.actuators) * (kind == "memory")
                    if not edge.drives:
                        influence[edge.to] += carried
                    came = Fraction(float(carried)), Fraction(float(own))
                    found.came.setdefault((kind, place), []).append((skill.index, *came))
        largest = max((sum(each[2] for each in came) for came in found.came.values()), default=0)
        return found if sound and largest < Fraction(float(np.finfo(np.float32).max)) else None

    def paths(self, target: Sink) -> Iterator[tuple[tuple[str, ...], Fraction, Fraction]]:
        """Each path to a target that carried influence: its names, its part and its share."""
        came = self.came.get(target, [])
        is_skill = target[0] == "skill"
        total = sum(carried if is_skill else own for _, carried, own in came)
        if total > 0:
            for skill, carried, own in came:
                part, share = (carried, carried) if is_skill else (own, carried)
                for names, along in self._along(skill):
                    yield (
                        (*names, self.graph.named(*target)),
                        along * part / total,
                        along * share / (1 if is_skill else total),
                    )

    def _along(self, skill: int) -> Iterator[tuple[tuple[str, ...], Fraction]]:
        name = self.graph.skills[skill].name
        if name == self.graph.master:
            yield (name,), Fraction(1)
            return
        for names, part, _ in self.paths(("skill", skill)):
            yield names, part


@given(random_case())
def test_shares_are_those_of_every_path_in_exact_fractions(case: Case) -> None:
    assume(len(case.graph.skills) <= MOST_SKILLS)
    run, graph = thought(case), case.graph
    flows = flows_of(case, run)
    with np.errstate(all="ignore"):
        made = hierarchy(Policy(graph, case.weights), procedure_sources(graph, PROCEDURES), graph.master)
        sent = [sent_values(made, run, row) for row in range(len(run.readings))]
        scopes = influence_scopes(graph)
        exact = [[Exact.of(graph, made, each, scope) for scope in range(len(scopes.without))] for each in sent]
    for row, ticks in enumerate(exact):
        for sink in sinks(flows) if ticks[0] else ():
            tick = ticks[scopes.of.get(sink, 0)]
            if sink == ("skill", flows.skills[0]):
                continue
            assert tick
            expected = {names: (part, share) for names, part, share in tick.paths(sink) if part}
            found = shares(flows, sink, range(row, row + 1), ALL)
            assert {each.path for each in found.paths} == expected.keys()
            assert found.rest.paths == 0
            for each in found.paths:
                part, share = expected[each.path]
                assert each.part == pytest.approx(float(part), rel=DOUBLES)
                assert each.share == pytest.approx(float(share), rel=DOUBLES)
            holds_what_the_engine_said(found, run, row)
            bounded(found, sum((share for _, share in expected.values()), Fraction(0)), len(tick.came.get(sink, [])))


@given(random_case(), st.integers(1, 4))
@settings(max_examples=cases(50))
def test_the_largest_paths_come_first_and_the_rest_is_what_they_leave(case: Case, paths: int) -> None:
    assume(len(case.graph.skills) <= MOST_SKILLS)
    run = thought(case)
    flows = flows_of(case, run)
    for sink in sinks(flows):
        for rows in (range(1), range(len(run.readings))):
            found, whole = (shares(flows, sink, rows, number) for number in (paths, ALL))
            sizes = [each.part for each in whole.paths]
            assert found.are_largest
            assert [each.part for each in found.paths] == pytest.approx(
                sorted(sizes, reverse=True)[:paths], rel=DOUBLES
            )
            named = {each.path for each in found.paths}
            others = [each.part for each in whole.paths if each.path not in named]
            assert found.rest.part == pytest.approx(fsum(others), abs=DOUBLES * max(1.0, found.influence))
            assert found.rest.paths == len(others) + whole.rest.paths


@given(random_case())
@settings(max_examples=cases(50))
def test_a_span_is_the_mean_of_its_ticks(case: Case) -> None:
    assume(len(case.graph.skills) <= MOST_SKILLS)
    run = thought(case)
    flows = flows_of(case, run)
    for sink in sinks(flows):
        single = [shares(flows, sink, range(row, row + 1), ALL) for row in range(len(run.readings))]
        found = shares(flows, sink, range(len(run.readings)), ALL)
        assert found.undriven == sum(each.undriven for each in single)
        sent = [each for each in single if each.command is not None]  # to a memory not in every tick
        assert (found.command is None) == (not sent)
        for of in ("command", "influence", "neutral"):
            values = [getattr(each, of) for each in sent]
            if getattr(found, of) is not None and values:
                assert getattr(found, of) == pytest.approx(fsum(values) / len(sent), rel=DOUBLES, abs=1e-300)
        for each in found.paths:
            same = [other for tick in sent for other in tick.paths if other.path == each.path]
            assert each.share == pytest.approx(fsum(other.share for other in same) / len(sent), rel=DOUBLES)
            assert each.part == pytest.approx(fsum(other.part for other in same) / len(sent), rel=DOUBLES)


def test_of_a_ladder_with_more_paths_than_anyone_can_count_the_largest_are_found() -> None:
    skills = doubling(100, (always("actuator", 0, 1.0),))
    case = Case(mind(*skills), {}, np.zeros((3, 1), np.float32))
    flows = flows_of(case, thought(case))
    for rows in (range(1), range(3)):
        found = shares(flows, ("actuator", 0), rows, 5)
        assert [each.part for each in found.paths] == [2.0**-100] * 5
        assert (found.rest.paths, found.rest.share, found.command, found.are_largest) == (10**15, 1.0, 1.0, True)


def test_of_two_thousand_parents_the_first_are_those_with_the_most_influence() -> None:
    parents = 2_000
    top = rule("Top", *(always("skill", 1 + number, (1 + number) / parents) for number in range(parents)))
    skills = [rule(f"S{number}", always("actuator", 0, 0.5)) for number in range(parents)]
    case = Case(mind(top, *skills), {}, np.zeros((1, 1), np.float32))
    found = shares(flows_of(case, thought(case)), ("actuator", 0), range(1), 2)
    assert [each.path for each in found.paths] == [("Top", f"S{parents - n}", "left_wheel") for n in (1, 2)]
    assert found.paths[0].part == pytest.approx(2 / (parents + 1), rel=1e-6)
    assert (found.rest.paths, found.command) == (parents - 2, pytest.approx(0.5, rel=1e-3))


def holds_what_the_engine_said(found: Shares, run: Thought, row: int) -> None:
    """The command is the engine's, bit for bit, and all parts of the answer make it."""
    match found.target:
        case "actuator", index:
            assert found.command == run.commands[row][index]
        case "skill", index:
            assert found.command == run.influence[row, index]
    made = [*(each.share for each in found.paths), found.rest.share, found.neutral or 0.0, found.rounding]
    assert (found.neutral is None) == (found.target[0] != "actuator")
    assert (found.command is None) == (found.target[0] == "memory" and found.undriven == 1)
    assert fsum(made) == pytest.approx(found.command or 0.0, rel=DOUBLES, abs=1e-300)
    assert found.undriven or fsum([*(each.part for each in found.paths), found.rest.part]) == pytest.approx(1.0)


def bounded(found: Shares, exact: Fraction, edges: int) -> None:
    """The command is off by no more than the roundings of two float32 sums over so many edges and one division.

    For influence there is one sum.
    """
    if found.undriven:
        return
    up, down = (1 + HALF_ULP) ** max(0, edges - 1), (1 - HALF_ULP) ** max(0, edges - 1)
    worst = up - 1 if found.target[0] == "skill" else up * (1 + HALF_ULP) / down - 1
    assert abs(Fraction(found.command) - exact) <= exact * worst + LEAST
