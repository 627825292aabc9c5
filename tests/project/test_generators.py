"""What the tests draw is all that the language can say: every kind, and every argument of it with several values."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from contextlib import suppress
from random import Random
from typing import Any

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.scenes.scene import Arena, Plain
from mindrun.kinds.sensors.compass import Compass
from mindrun.kinds.sensors.nearest import Bearing
from mindrun.kinds.sensors.rays import RangeFinder

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from tests.edits.sources import a_mind
from tests.hierarchies import VIRTUAL, physical_kinds, random_graph, virtual_kinds
from tests.outside.drawn import environment_mind
from tests.sim.drawn_teams import teams
from tests.sim.worlds import _events, _measures, _things, learner_kinds, robot_kinds

DRAWN = 400  # minds, and lists of kinds
FEW, MANY = 20, 120  # lists of one sort, and of several or minds, that bring nothing new
NOUNS = ("body", "actuator", "sensor", "memory", "skill", "task", "content", "event", "measure", "curriculum")
OF_FILES = {"map"}  # which no text says by itself
KNOWN = {"s0": Bearing("object"), "s1": RangeFinder(at=(-1.0, 0.0, 1.0)), "s2": Compass()}  # of what sensors are made
WIDTHS = {"s0": 1, "s1": 3, "s2": 1, "m0": 1}
ONE_VALUE = {("visit", "of"), ("change", "of")}  # the language has a single word for it


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


class Missing:
    """The arguments of kinds that were not drawn yet with several values; "" stands for the kind itself."""

    def __init__(self, *left_out: str) -> None:
        self.texts, self.wanted = {}, {}
        self.values: dict[tuple[type[Any], str], set[Any]] = defaultdict(set)
        for noun in NOUNS:
            for kind, cls in kinds(noun).items():
                if kind in left_out:
                    continue
                self.texts[cls, ""], self.wanted[cls, ""] = f"{noun} {kind}", 1
                for argument in arguments(cls):
                    key = cls, argument.field
                    self.texts[key] = f"{noun} {kind}: {argument.key}"
                    self.wanted[key] = 1 if (kind, argument.key) in ONE_VALUE else 2

    def strike(self, drawn: Iterable[Any]) -> None:
        """Strike out what these kinds have."""
        for part in drawn:
            for field in ("", *(argument.field for argument in arguments(type(part)))):
                key = type(part), field
                if key in self.texts:
                    self.values[key].add(getattr(part, field) if field else ())
                    if len(self.values[key]) >= self.wanted[key]:
                        del self.texts[key]


class EnoughError(Exception):
    """Nothing is missing any longer."""


def strike_drawn(missing: Missing, strategy: st.SearchStrategy[Iterable[Any]], idle: int) -> None:
    """Draw lists of kinds until nothing is missing, or so many of them in a row strike out nothing."""
    left = idle

    @settings(max_examples=DRAWN, database=None, phases=[Phase.generate], suppress_health_check=list(HealthCheck))
    @given(strategy)
    def take(drawn: Iterable[Any]) -> None:
        nonlocal left
        before = len(missing.texts)
        missing.strike(drawn)
        left = idle if left and len(missing.texts) < before else max(left - 1, 0)  # the last is taken again
        if not (missing.texts and left):
            raise EnoughError

    with suppress(EnoughError):
        take()


@st.composite
def task_kinds(draw: st.DrawFn) -> list[Any]:
    """What stands in a task."""
    scene = draw(st.sampled_from([Plain(), Arena(20.0), Arena((26.0, 15.0))]))
    things = draw(_things(scene, (), draw(teams([]))))
    return [scene, *(each.kind for each in things), *draw(_measures(things)), *draw(_events(scene, things))]


def environments() -> Iterator[Graph]:
    """Minds in environments that are drawn; nobody asks whether they fit."""
    for seed in range(DRAWN):
        graph = compile_source(Source("drawn.mind", environment_mind(Random(seed), "drawn:"))).graph
        assert graph
        yield graph


def texts() -> Iterator[Graph]:
    """Minds in texts that are drawn."""
    for seed in range(DRAWN):
        graph = a_mind(Random(seed)).compiled().graph
        assert graph
        yield graph


def strike_graphs(missing: Missing, *several: Iterator[Graph]) -> None:
    """Strike out what stands in these minds until nothing is missing, or so many of a sort strike out nothing."""
    for graphs in several:
        left = MANY
        while missing.texts and left:
            before = len(missing.texts)
            missing.strike(parts(next(graphs)))
            left = MANY if len(missing.texts) < before else left - 1


def test_every_kind_is_drawn_with_every_argument() -> None:
    missing = Missing()
    virtual = VIRTUAL.flatmap(lambda kind: virtual_kinds(kind, WIDTHS, KNOWN)).map(lambda drawn: drawn[1])
    strike_graphs(missing, environments())
    for each, idle in ((physical_kinds(), MANY), (virtual, FEW), (learner_kinds(), FEW), (robot_kinds(), FEW)):
        strike_drawn(missing, st.lists(each, min_size=24), idle)
    strike_drawn(missing, task_kinds(), MANY)
    strike_drawn(missing, random_graph().map(parts), DRAWN)
    assert [*missing.texts.values()] == []


def test_every_kind_is_said_in_a_text_with_every_argument() -> None:
    missing = Missing(*OF_FILES)
    strike_graphs(missing, environments(), texts())
    assert [*missing.texts.values()] == []
