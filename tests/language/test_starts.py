"""Where a task or a scene says that the robot starts."""

from math import cos, pi, sin
from pathlib import Path

import pymunk
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph, Start
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.beginning import Outline, overlap
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds
from tests.draws import cases

MIND = """\
tick 1/60 s
master Go
body Robot is disc size 1
actuator left is wheel side left neutral 0.5
sensor north is compass
skill Go is mlp
  reads north
  drives left
scene Yard is arena size 40 30
  starts at 5 -5 facing 90 deg
task Home in Yard
  lasts 60 ticks
  rewards forward per tick
task Away in arena size 40
START  lasts 60 ticks
  rewards forward per tick
curriculum School is genetic
  teaches Go on Away for 3 generations
"""


def compiled(line: str) -> Graph:
    graph = compile_source(Source("a.mind", MIND.replace("START", f"  {line}\n" if line else ""), Path())).graph
    assert graph
    return graph


@pytest.mark.parametrize(
    ("line", "start"),
    [
        ("", Start()),
        ("starts at 1 2", Start((1.0, 2.0))),
        ("starts facing -90 deg", Start(None, -pi / 2)),
        ("starts at 0 0 facing 180 deg", Start((0.0, 0.0), pi)),
    ],
)
def test_a_run_begins_where_its_task_says(line: str, start: Start) -> None:
    graph = compiled(line)
    assert [task.start for task in graph.tasks] == [Start((5.0, -5.0), pi / 2), start]
    rollout = Rollout(Policy(graph, {}), "Away", "Go", ["Go"])
    begins = [trace(rollout, seed).begin.tolist() for seed in range(3)]
    assert len({(x, y) for x, y, _ in begins}) == (1 if start.at else 3)
    assert len({angle for *_, angle in begins}) == (3 if start.facing is None else 1)
    assert not start.at or begins[0][:2] == [*start.at]


def test_another_start_is_another_world() -> None:
    def world(line: str):  # type: ignore[no-untyped-def]
        graph = compiled(line)
        return Worlds(graph, None).of(graph.lessons[0])

    assert changes(world("starts at 1 2"), world("starts at 1 2")) == []
    assert changes(world("starts at 1 2"), world("starts at 1 3 facing 90 deg")) == [
        "its task has changed: starts at 1 3 facing 90 deg, before starts at 1 2"
    ]
    assert changes(world("starts at 1 2"), world("")) == ["its task has changed: starts anywhere, before starts at 1 2"]


@pytest.mark.parametrize(("side", "size"), [(0.6, 0.2), (1.1, 0.7), (3.3, 1.1)])
def test_a_robot_may_touch_the_border_whatever_decimals_add_up_to(side: float, size: float) -> None:
    text = MIND.replace("disc size 1", f"disc size {size}").replace("arena size 40\n", f"arena size {side}\n")
    at = round((side - size) / 2, 3)
    for start in (f"{at} 0", f"0 -{at}"):
        graph = compile_source(Source("a.mind", text.replace("START", f"  starts at {start}\n"), Path())).graph
        assert graph, start
    beyond = compile_source(Source("a.mind", text.replace("START", f"  starts at {at + 0.001} 0\n"), Path()))
    assert [each.code for each in beyond.diagnostics] == ["outside-arena"]


BOX = "START", "  starts at {}\n  contains crate is box size 2 at 3 0\n"


@pytest.mark.parametrize(
    ("start", "body", "code"),
    [
        ("1.6 0", "disc size 1", "inside-obstacle"),
        ("1.5 0", "disc size 1", ""),
        ("1.9 0", "nothing", ""),  # of a body that nobody knows its middle alone is held against things
        ("2.1 0", "nothing", "inside-obstacle"),
        ("20 0", "nothing", ""),
        ("20.1 0", "nothing", "outside-arena"),
        ("1.4 0 facing 0 deg", "box size 3 1", "inside-obstacle"),
        ("1.4 0 facing 90 deg", "box size 3 1", ""),
        ("1.4 0", "box size 3 1", ""),  # in some runs, which is for lint
    ],
)
def test_a_robot_does_not_start_in_something(start: str, body: str, code: str) -> None:
    text = MIND.replace("disc size 1", body).replace(BOX[0], BOX[1].format(start))
    found = [each.code for each in compile_source(Source("a.mind", text, Path())).diagnostics]
    assert [each for each in found if each in ("inside-obstacle", "outside-arena")] == [code] * bool(code)


@pytest.mark.parametrize(
    ("times", "places", "is_decided"), [(1, "3 0", True), (2, "3 0", False), (2, "3 0 to 0 2", True)]
)
def test_no_run_is_over_before_it_begins(times: int, places: str, is_decided: bool) -> None:
    lines = (
        f"  starts at 1 0 facing 0 deg\n  contains coin is item size 1 at {places}\n  ends on {times} reach of coin\n"
    )
    text = MIND.replace("START", lines.replace("0 2", "2.5 1"))
    found = compile_source(Source("a.mind", text, Path())).diagnostics
    assert [each.code for each in found] == ["decided-start"] * is_decided


@pytest.mark.parametrize(("count", "code"), [(99, []), (100, ["too-many-things"])])
def test_a_world_takes_a_hundred_things(count: int, code: list[str]) -> None:
    lines = f"  contains coin is item size 0.1\n  contains crate is box size 0.1 count {count}\n"
    found = compile_source(Source("a.mind", MIND.replace("START", lines), Path())).diagnostics
    assert [each.code for each in found] == code


@pytest.mark.parametrize("place", ["2 s 5", "5 2 s"])
def test_a_place_in_seconds_is_one_mistake(place: str) -> None:
    found = compile_source(Source("a.mind", MIND.replace("START", f"  starts at {place}\n"), Path())).diagnostics
    assert [each.message for each in found] == ["The unit s does not fit here."]


NUMBERS = st.floats(-4, 4).map(lambda value: round(value, 2))
SIDES = st.floats(0.1, 4).map(lambda value: round(value, 2))


@st.composite
def outlines(draw: st.DrawFn) -> Outline:
    """A disc, or a rectangle in any direction whose corners are round or not."""
    x, y, half_x, half_y, angle = (draw(of) for of in (NUMBERS, NUMBERS, SIDES, SIDES, NUMBERS))
    if draw(st.booleans()):
        return Outline(((x, y),), half_x)
    sides = ((half_x, half_y), (half_x, -half_y), (-half_x, -half_y), (-half_x, half_y))
    turned = tuple((x + cos(angle) * a - sin(angle) * b, y + sin(angle) * a + cos(angle) * b) for a, b in sides)
    return Outline(turned, draw(st.sampled_from([0.0, 0.5])))


def do_shapes_meet(one: Outline, other: Outline) -> bool:
    """True if they overlap as Chipmunk has it."""
    space = pymunk.Space()
    first, second = (
        pymunk.Poly(space.static_body, of.corners, radius=of.rim)
        if len(of.corners) > 1
        else pymunk.Circle(space.static_body, of.rim, of.corners[0])
        for of in (one, other)
    )
    space.add(first)
    return bool(space.shape_query(second))


@settings(max_examples=cases(1000))
@given(outlines(), outlines())
def test_outlines_overlap_as_shapes_of_chipmunk_do(one: Outline, other: Outline) -> None:
    nearly = {overlap(one._replace(rim=max(0.0, one.rim + more)), other) for more in (-0.01, 0.01)}
    if len(nearly) == 1:  # they do not just touch
        assert overlap(one, other) == do_shapes_meet(one, other)
