"""A run with changes: none are no change, and each is what the engine and a mind that says it so make of it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from mindrun.engine.changes import Change, ChangedEngine, ChangeError, change_of, in_tick, silenced
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.minds import compile_text
from tests.sim.test_random_worlds import Weights, weights_for
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]
SEEDS = st.integers(0, 2**32 - 1)
SHARES = st.sampled_from([0.0, 0.1, 0.5, 0.9, 1.0])


def sensed(graph: Graph) -> int:
    """How many readings its sensors have."""
    return sum(sensor.width for sensor in graph.sensors)


@st.composite
def changes_of(draw: st.DrawFn, graph: Graph) -> tuple[Change, ...]:
    """Up to four changes of anything, from any tick on."""
    known = [("influence", number) for number in range(len(graph.skills))]
    known += [("reading", row) for row in range(sensed(graph))] * 2
    known += [("memory", memory.start) for memory in graph.memories]
    found = []
    for what, row in draw(st.lists(st.sampled_from(known), min_size=1, max_size=4)):
        first = draw(st.integers(1, 12))
        last = draw(st.none() | st.integers(first, first + 9))
        values = tuple(draw(st.lists(SHARES, min_size=1, max_size=3)))
        found.append(Change(what, row, values, first, last))
    return tuple(found)


def rollout_of(graph: Graph, weights: Weights) -> Rollout:
    return Rollout(Policy(graph, weights), "World", graph.master, procedures=PROCEDURES)


def moments(rollout: Rollout, seed: int, changes: Sequence[Change] = ()) -> list[Moment]:
    return list(trace(rollout, seed, changes=changes).moments)


def same(one: Moment, other: Moment, but: Sequence[str] = ()) -> bool:
    """Whether two moments are the same to the bit, but for some of what there is in them."""
    return all(
        np.asarray(getattr(one, name)).tobytes() == np.asarray(getattr(other, name)).tobytes()
        for name in Moment.__slots__
        if name not in but
    )


def all_same(some: Sequence[Moment], others: Sequence[Moment], but: Sequence[str] = ()) -> bool:
    return len(some) == len(others) and all(same(a, b, but) for a, b in zip(some, others, strict=True))


@settings(max_examples=cases(40), suppress_health_check=SLOW)
@given(random_world(), st.data(), st.sampled_from(SCALES), SEEDS)
def test_the_engine_makes_the_same_of_a_change(graph: Graph, data: Any, scale: float, seed: int) -> None:
    """Also where what is replaced is a source of other sensors, or is computed itself."""
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    changes = data.draw(changes_of(graph))
    rollout, engine = rollout_of(graph, weights), ChangedEngine(Policy(graph, weights), PROCEDURES)
    rows = [row for each in rollout.tables.sensors for row in range(each["start"], each["start"] + each["width"])]
    run = trace(rollout, seed % 1000, changes=changes)
    delayed = {i for i, actuator in enumerate(graph.actuators) if actuator.kind.delay}
    delayed |= {i for i, a in enumerate(graph.actuators) if any(v.of == a.name for v in rollout.task.varies)}
    prompt = [i for i in range(len(graph.actuators)) if i not in delayed]
    faults = 0
    for moment in run.moments:
        made = in_tick(changes, moment.tick)
        commands = engine.tick_with(moment.readings, made)
        assert np.array_equal(engine.readings[rows], moment.readings[rows], equal_nan=True)
        assert engine.influence.tobytes() == moment.influence.tobytes()
        assert np.array_equal(commands[prompt], moment.commands[prompt])
        faults = engine.faults
    event(f"{len(changes)} changes")
    assert run.jobs.faults[0] == faults


@settings(max_examples=cases(25), suppress_health_check=SLOW)
@given(random_world(), st.data(), st.sampled_from(SCALES), SEEDS)
def test_what_changes_nothing_changes_no_bit(graph: Graph, data: Any, scale: float, seed: int) -> None:
    """In every tick what was read and thought anyway is put in the place of itself."""
    rollout = rollout_of(graph, weights_for(graph, scale, np.random.default_rng(seed)))
    plain = moments(rollout, seed % 1000)
    row = data.draw(st.integers(0, max(sensed(graph) - 1, 0)))
    skill = data.draw(st.integers(0, len(graph.skills) - 1))
    changes = [Change("influence", skill, tuple(float(m.influence[skill]) for m in plain), 1)]
    said = tuple(float(m.readings[row]) for m in plain)
    if sensed(graph):
        changes.append(Change("reading", row, said, 1))
    assert all_same(plain, moments(rollout, seed % 1000, changes))


@settings(max_examples=cases(25), suppress_health_check=SLOW)
@given(random_world(), st.data(), st.sampled_from(SCALES), SEEDS)
def test_nothing_differs_before_the_change(graph: Graph, data: Any, scale: float, seed: int) -> None:
    rollout = rollout_of(graph, weights_for(graph, scale, np.random.default_rng(seed)))
    changes = data.draw(changes_of(graph))
    plain, other = moments(rollout, seed % 1000), moments(rollout, seed % 1000, changes)
    calm = min(change.first for change in changes) - 1
    assert all_same(plain[:calm], other[:calm])


@settings(max_examples=cases(25), suppress_health_check=SLOW)
@given(random_world(), st.data(), st.sampled_from(SCALES), SEEDS)
def test_silenced_is_as_if_all_edges_to_it_were_cut(graph: Graph, data: Any, scale: float, seed: int) -> None:
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    number = data.draw(st.integers(1, len(graph.skills) - 1)) if len(graph.skills) > 1 else 0
    if number == 0:
        return
    cut = [
        replace(
            skill,
            edges=tuple(
                replace(edge, cuts=1e30) if (edge.to, edge.target) == ("skill", number) else edge
                for edge in skill.edges
            ),
        )
        for skill in graph.skills
    ]
    changes = silenced(graph, graph.skills[number].name)
    without = moments(rollout_of(replace(graph, skills=tuple(cut)), weights), seed % 1000)
    assert all_same(moments(rollout_of(graph, weights), seed % 1000, changes), without)


GAZE = """
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eyes is {eyes}
sensor rate is derivative of eyes
sensor both is computed at eyes * 0.5 + rate * 0.3
memory mood is cell decay 0.9
skill Go is rule
  reads eyes
  reads both
  reads mood
  drives left_wheel at eyes
  drives right_wheel at both
  drives mood at both
task Roam in arena size 40
  contains rock is obstacle grid 10 size 2 to 3
  lasts 200 ticks
  rewards forward per tick
  rewards 0.1 * p per tick for each p in eyes
"""


def gaze(eyes: str) -> tuple[Graph, list[Moment], Rollout]:
    graph = compile_text(GAZE.format(eyes=eyes))
    rollout = Rollout(Policy(graph, {}), "Roam", "Go")
    return graph, moments(rollout, 5), rollout


def test_a_constant_is_as_if_the_sensor_were_one() -> None:
    """What derives from it, remembers it and is paid for it sees the same."""
    graph, plain, rollout = gaze("range_finder at 0 deg range 12")
    _, expected, _ = gaze("computed at 0.25")
    changed = moments(rollout, 5, change_of(graph, "reading", "eyes", [[0.25]]))
    assert all_same(changed, expected)
    assert not all_same(changed, plain)


def test_a_memory_goes_on_from_what_it_is_made() -> None:
    graph, plain, rollout = gaze("range_finder at 0 deg range 12")
    cell = graph.memories[0].start
    changed = moments(rollout, 5, change_of(graph, "memory", "mood", [[1.0]], 50, 50))
    mood = np.array([moment.readings[cell] for moment in changed])
    assert abs(mood[49] - mood[50]) < 0.11, "as read in the tick after, or in its own"
    assert mood[52] > np.array([moment.readings[cell] for moment in plain])[52]


@pytest.mark.parametrize(
    ("what", "name", "values", "said"),
    [
        ("reading", "eye", [[0.5]], "there is no sensor called eye"),
        ("reading", "eyes", [[1.5]], "eyes cannot be 1.5"),
        ("reading", "eyes", [[float("nan")]], "eyes cannot be nan"),
        ("reading", "eyes", [[0.5, 0.5]], "sensor eyes has 1 reading"),
        ("reading", "eyes", [], "sensor eyes has 1 reading"),
        ("influence", "eyes", [[0.5]], "there is no skill called eyes"),
        ("influence", "Go", [[0.5, 0.5]], "skill Go has 1 influence$"),
        ("memory", "mood", [[0.5, 0.5]], "memory mood has 1 number$"),
        ("influence", "Go", [[-1.0]], "Go cannot be -1"),
        ("memory", "mod", [[0.5]], "there is no memory called mod"),
    ],
)
def test_what_cannot_be_changed_is_said(what: Any, name: str, values: Any, said: str) -> None:
    graph = compile_text(GAZE.format(eyes="computed at 0.25"))
    with pytest.raises(ChangeError, match=said):
        change_of(graph, what, name, values)
