"""What the tests draw is all that the language can say: every kind, and every argument of it with several values."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.kinds.registry import arguments, kinds

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from tests.edits.sources import a_mind
from tests.hierarchies import VIRTUAL, physical_kinds, virtual_kinds
from tests.outside.drawn import environment_mind
from tests.sim.worlds import learner_kinds, random_world, robot_kinds

DRAWN, DRAWN_LISTS = 200, 50  # minds, and lists of kinds of which ten are enough
NOUNS = ("body", "actuator", "sensor", "memory", "skill", "task", "content", "event", "measure", "curriculum")
OF_FILES = {"map"}  # which no text says by itself
WIDTHS = {"s0": 1, "s1": 3, "m0": 1}  # of what sensors are made of
ONE_VALUE = {("visit", "of"), ("change", "of")}  # the language has a single word for it

Values = dict[tuple[type[Any], str], set[Any]]


def parts(graph: Graph) -> Iterator[Any]:
    """Every kind that stands in a mind."""
    yield graph.body
    yield from (part.kind for part in (*graph.sensors, *graph.memories, *graph.actuators))
    yield from (skill.function for skill in graph.skills)
    yield from (lesson.learner for lesson in graph.lessons)
    for task in graph.tasks:
        yield task.scene
        yield from (thing.kind for thing in task.things)
        yield from (*task.events, *task.measures)


def of_worlds() -> Iterator[Any]:
    """Kinds in worlds that are drawn, and more of those that have too many arguments for so few worlds."""
    for graph in drawn_from(random_world()):
        yield from parts(graph)
    yield from of_environments()
    virtual = VIRTUAL.flatmap(lambda kind: virtual_kinds(kind, WIDTHS)).map(lambda drawn: drawn[1])
    some = ((physical_kinds(), DRAWN), *((each, DRAWN_LISTS) for each in (virtual, learner_kinds(), robot_kinds())))
    for kinds_of, lists in some:
        for drawn in drawn_from(st.lists(kinds_of, min_size=24), lists):
            yield from drawn


def of_environments() -> Iterator[Any]:
    """Kinds in environments that are drawn; nobody asks whether they fit."""
    for seed in range(DRAWN):
        graph = compile_source(Source("drawn.mind", environment_mind(Random(seed), "drawn:"))).graph
        assert graph
        yield from parts(graph)


def drawn_from(strategy: st.SearchStrategy[Any], count: int = DRAWN) -> list[Any]:
    """So many examples of a strategy."""
    found: list[Any] = []

    @settings(max_examples=count, database=None, suppress_health_check=list(HealthCheck))
    @given(strategy)
    def draw(example: Any) -> None:
        found.append(example)

    draw()
    return found


def of_texts() -> Iterator[Any]:
    """Kinds in texts that are drawn."""
    for seed in range(DRAWN):
        graph = a_mind(Random(seed)).compiled().graph
        assert graph
        yield from parts(graph)
    yield from of_environments()


@cache
def values(drawn: Callable[[], Iterable[Any]]) -> Values:
    """The values of every argument of every kind; "" stands for the kind itself."""
    found: Values = defaultdict(set)
    for part in drawn():
        found[type(part), ""].add(())
        for argument in arguments(type(part)):
            found[type(part), argument.field].add(getattr(part, argument.field))
    return found


@pytest.mark.parametrize("drawn", [of_worlds, of_texts])
@pytest.mark.parametrize("noun", NOUNS)
def test_every_kind_is_drawn_with_every_argument(drawn: Callable[[], Iterable[Any]], noun: str) -> None:
    found = values(drawn)
    for kind, cls in kinds(noun).items():
        if drawn is of_texts and kind in OF_FILES:
            continue
        assert (cls, "") in found, f"no {noun} is drawn that is {kind}"
        for argument in arguments(cls):
            said = found[cls, argument.field]
            assert len(said) > 1 or (kind, argument.key) in ONE_VALUE, f"{noun} {kind}: {argument.key} is always {said}"
