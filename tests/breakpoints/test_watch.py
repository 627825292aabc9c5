"""Where a run stops is where a loop over its rows finds that it should."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.engine import procedure_sources
from mindrun.engine.think import Hierarchy, hierarchy, think
from mindrun.graph.policy import Policy
from mindrun.kinds.events.event import Collision, Exhaustion
from mindrun.numbers.expression import Program, evaluate
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, Transmission
from mindlang.breakpoints.watch import RowBlock, Stop, Transmissions, Watcher
from tests.breakpoints.subjects import part, subject
from tests.hierarchies import PROCEDURES, Case, conditions, programs, random_case

WIDTH, TICKS = 3, 12
NO_SKILLS = Hierarchy((), np.zeros(0, np.float32), 0, 0)
READINGS = st.sampled_from([0.0, 0.1, 0.25, 1.0, np.nan, np.inf, -1.0]) | st.floats(0, 1, width=32)


@dataclass(frozen=True)
class Watched:
    """Breakpoints and the rows that they are about."""

    breakpoints: tuple[Breakpoint, ...]
    rows: RowBlock


@st.composite
def random_watched(draw: st.DrawFn) -> Watched:
    numbers = draw(st.lists(st.lists(READINGS, min_size=WIDTH, max_size=WIDTH), min_size=TICKS, max_size=TICKS))
    happened = draw(st.lists(st.lists(st.integers(0, 2), min_size=2, max_size=2), min_size=TICKS, max_size=TICKS))
    causes = st.one_of(
        conditions(programs(tuple(range(WIDTH)))).map(lambda program: Holds(program, (), ())),
        st.builds(Happens, st.sampled_from([Collision(), Exhaustion()]), st.integers(0, 4)),
        st.integers(1, TICKS + 2).map(Reaches),
    )
    found = draw(st.lists(causes, min_size=1, max_size=4))
    nothing = np.zeros((TICKS, 0), np.float32)
    return Watched(
        tuple(Breakpoint(line, "", cause) for line, cause in enumerate(found)),
        RowBlock(np.array(numbers, np.float32), nothing, nothing, np.cumsum(happened, axis=0)),
    )


def watcher(watched: Watched) -> Watcher:
    return Watcher(watched.breakpoints, (Collision(), Exhaustion()), subject().graph, NO_SKILLS)


def where(stops: list[Stop]) -> list[tuple[int, int]]:
    return [(stop.tick, stop.breakpoint.line) for stop in stops]


def obvious(watched: Watched) -> list[tuple[int, int]]:
    """The stops, row by row."""
    found = []
    for row in range(TICKS):
        before, here = (row_or_none(watched.rows, at) for at in (row - 1, row))
        assert here is not None
        for each in watched.breakpoints:
            match each.cause:
                case Holds(program):
                    stops = holds(program, here[0]) and not (before and holds(program, before[0]))
                case Happens(event, times):
                    column = (Collision(), Exhaustion()).index(event)
                    now, then = here[1][column], before[1][column] if before else 0
                    stops = then < times <= now if times else now > then
                case Reaches(tick):
                    stops = tick == row + 1
            if stops:
                found.append((row + 1, each.line))
    return found


def row_or_none(rows: RowBlock, at: int) -> tuple[NDArray[np.float32], NDArray[np.int64]] | None:
    return (rows.readings[at], rows.events[at]) if at >= 0 else None


def holds(program: Program, readings: NDArray[np.float32]) -> bool:
    with np.errstate(all="ignore"):
        return bool(evaluate(program, readings) > 0)


@given(random_watched())
def test_a_run_stops_where_a_loop_over_its_rows_stops(watched: Watched) -> None:
    assert where(watcher(watched).feed(watched.rows)) == obvious(watched)


@given(random_watched(), st.lists(st.integers(0, TICKS), max_size=4))
def test_rows_that_come_in_parts_stop_a_run_where_they_do_at_once(watched: Watched, cuts: list[int]) -> None:
    bounds = [0, *sorted(cuts), TICKS]
    watching = watcher(watched)
    found = [stop for first, end in pairwise(bounds) for stop in watching.feed(part(watched.rows, first, end))]
    assert found == watcher(watched).feed(watched.rows)
    assert watching.ticks == TICKS


@given(random_case())
def test_all_weights_together_are_what_thinking_adds_up(case: Case) -> None:
    """Toward a skill its influence; toward what is driven the whole, or nothing where nothing drives it."""
    graph, watching = case.graph, ready(case)
    influence, asked = influence_of(case, case.readings), all_sent(case)
    weights = Transmissions(asked, graph, watching).feed(case.readings, influence)
    for to, target in {(each.to, each.target) for each in asked}:
        arriving = [
            weight for each, weight in zip(asked, weights, strict=True) if (each.to, each.target) == (to, target)
        ]
        whole = np.sum(arriving, axis=0)
        certain = np.isfinite(whole) & np.isfinite(influence).all(axis=1)
        if to == "skill":
            assert np.allclose(whole[certain], influence[certain, target], rtol=1e-5)
        else:
            assert np.isin(np.round(whole[certain], 5), [0, 1]).all()


@given(random_case(), st.integers(0, 100))
def test_where_a_mind_is_begun_anew_its_weights_are_as_at_the_beginning(case: Case, cut: int) -> None:
    halves = np.split(case.readings, [cut % (len(case.readings) + 1)])
    influence, asked = [influence_of(case, half) for half in halves], all_sent(case)
    whole, parts = (Transmissions(asked, case.graph, ready(case)) for _ in range(2))
    alone = [Transmissions(asked, case.graph, ready(case)).feed(*half) for half in zip(halves, influence, strict=True)]
    found = whole.feed(case.readings, np.concatenate(influence), [0, len(halves[0])])
    assert np.array_equal(found, np.concatenate(alone, axis=1), equal_nan=True)
    for fed, expected in zip(zip(halves, influence, strict=True), alone, strict=True):
        assert np.array_equal(parts.feed(*fed, [0]), expected, equal_nan=True)


def influence_of(case: Case, readings: NDArray[np.float32]) -> NDArray[np.float32]:
    """What a mind thinks from its beginning on."""
    mind = ready(case)
    with np.errstate(all="ignore"):
        thought = [think(mind, row).influence for row in readings]
    return np.array(thought, np.float32).reshape(len(readings), len(case.graph.skills))


def all_sent(case: Case) -> list[Transmission]:
    """From each skill to each of its targets."""
    return [
        Transmission(skill.index, to, target)
        for skill in ready(case).skills
        for to, target in {(edge.to, edge.target) for edge in case.graph.skills[skill.index].edges}
    ]


def ready(case: Case) -> Hierarchy:
    """The hierarchy of a case, as at the beginning of a run."""
    sources = procedure_sources(case.graph, PROCEDURES)
    return hierarchy(Policy(case.graph, case.weights), sources, case.graph.master)
