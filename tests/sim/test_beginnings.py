"""No run begins decided, and no two bodies in one place, says plain geometry of `check`, `lint` and the placement."""

from collections.abc import Iterator
from itertools import combinations
from math import cos, hypot, sin
from typing import NamedTuple
from unittest.mock import patch

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.model import Mind, Task
from mindlang.compiler.source import Source
from mindlang.lint.lint import lint
from mindlang.lint.rules import crowded_world
from tests.draws import cases

ROBOT = """
tick 1/20 s
master Stand
body Robot is disc size {}
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor in_home is inside of home
skill Stand is rule
  drives left_wheel at 0.5
  drives right_wheel at 0.5
"""
KINDS = {"home": "zone", "plug": "power", "coin": "item", "crate": "box", "puck": "ball", "cat": "walker speed 0.001"}
PLACES = st.tuples(st.integers(-9, 9), st.integers(-9, 9))
SIZES = st.sampled_from(["1", "2", "4", "9", "2 to 5", "4 to 2 by 1"])
SOLID = [
    "rock is obstacle count 3 size 2",
    "rock is obstacle grid 8 size 1 to 3 jitter 1",
    "rock is obstacle size 3 at -3 4",
]
SOLID += ["fence is wall from -8 -3 to 4 -3 thickness 0.5", ""]
ENDS = ["succeeds on reach of {}", "ends on reach of {}", "rewards 1 on reach of {}"]
BEGINNING = ("same-place", "inside-obstacle", "decided-start", "outside-arena")
RULES = ["crowded-world", "chance-meeting", "paid-at-once"]
LITTLE = 1e-5


@st.composite
def worlds(draw: st.DrawFn) -> str:
    """A robot that stands still in a world of anything, some of it at places, some of it drawn."""
    names = [*draw(st.lists(st.sampled_from([*KINDS]), unique=True, min_size=1, max_size=4)), "home"]
    lines = []
    for name in dict.fromkeys(names):
        where = draw(st.sampled_from(["", "", " away 0 to 6", " count 2", " reached moves", " at", " at", " at two"]))
        places = [draw(PLACES), draw(PLACES)][: 2 if where == " at two" else 1]
        at = " at " + " to ".join(f"{x} {y}" for x, y in places) if where.startswith(" at") else where
        lines.append(f"contains {name} is {KINDS[name]} size {draw(SIZES)}{at}")
    lines += [f"contains {solid}" for solid in (draw(st.sampled_from(SOLID)),) if solid]
    x, y = draw(PLACES)
    lines.append(
        draw(st.sampled_from(["", "", f"starts at {x} {y}", f"starts at {x} {y} facing 30 deg", "starts facing 1 deg"]))
    )
    lines += [draw(st.sampled_from(ENDS)).format(name) for name in dict.fromkeys(names)]
    lines += draw(
        st.sampled_from(
            [[], ["ends when in_home > 0.5"], ["succeeds on delivery of crate"] if "crate" in names else []]
        )
    )
    scene = draw(st.sampled_from(["arena size 26", "arena size 40 24", "plain"]))
    body = ROBOT.format(draw(st.sampled_from([2, 1, 3.5])))
    return f"{body}task Hall in {scene}\n" + "".join(f"  {line}\n" for line in (*lines, "lasts 3 ticks") if line)


class Shape(NamedTuple):
    """A disc or a square at a place, of half that size."""

    x: float
    y: float
    half_x: float
    half_y: float
    is_round: bool

    def covers(self, other: "Shape") -> bool:
        """Whether both have more in common than a rim."""
        dx, dy = abs(self.x - other.x), abs(self.y - other.y)
        if self.is_round and other.is_round:
            return hypot(dx, dy) < self.half_x + other.half_x - LITTLE
        if not self.is_round and not other.is_round:
            return dx < self.half_x + other.half_x - LITTLE and dy < self.half_y + other.half_y - LITTLE
        disc, square = (self, other) if self.is_round else (other, self)
        return hypot(max(0.0, dx - square.half_x), max(0.0, dy - square.half_y)) < disc.half_x - LITTLE


def bodies(
    task: Task, things: list[tuple[float, float, float]], boxes: list[tuple[float, ...]]
) -> Iterator[tuple[Shape, bool]]:
    """What takes up room, and whether it is fixed."""
    kinds = [each.kind for each in task.things if not each.kind.is_obstacle for _ in range(each.kind.copies)]
    for kind, (x, y, size) in zip(kinds, things, strict=True):
        if not kind.is_area:
            yield Shape(x, y, size / 2, size / 2, kind.is_round), False
    yield from ((Shape(*box, is_round=False), True) for box in boxes)


def decided(mind: Mind, things: list[tuple[float, float, float]], begin: tuple[float, float, float]) -> set[str]:
    """The things that a robot has reached where it begins."""
    [task], (x, y, angle), front = mind.tasks, begin, mind.body.kind.front
    found = set()
    named = [
        (each.name, each.kind) for each in task.things if not each.kind.is_obstacle for _ in range(each.kind.copies)
    ]
    for (name, kind), (to_x, to_y, size) in zip(named, things, strict=True):
        dx, dy = to_x - x, to_y - y
        ahead, aside = cos(angle) * dx + sin(angle) * dy - front, cos(angle) * dy - sin(angle) * dx
        in_claw = ahead >= LITTLE and hypot(ahead, aside) <= 1.5 + size / 2 - LITTLE
        if max(abs(dx), abs(dy)) <= size / 2 - LITTLE if kind.is_area else in_claw:
            found.add(name)
    return found


@settings(
    max_examples=cases(60), deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)
@given(worlds(), st.integers(0, 2**31))
def test_no_run_begins_decided_or_in_something(text: str, seed: int) -> None:
    compiled = compile_source(Source("hall.mind", text))
    codes = {diagnostic.code for diagnostic in compiled.diagnostics}
    assert codes <= {*BEGINNING, "on-the-robot", "endless-grid"}, text
    assume(compiled.graph is not None)
    assert compiled.mind
    assert compiled.graph
    with patch.object(crowded_world, "MAX_WORLDS", 100), patch.object(crowded_world, "MAX_LOOKS", 10_000_000):
        assume(not lint(compiled, RULES))  # a world of which one layout in a hundred lacks a place is no case
    [task], rollout = compiled.mind.tasks, Rollout(Policy(compiled.graph, {}), "Hall", "Stand")
    scores = rollout.score(Rollout.draw(rollout, 1, None), [seed, seed + 1, seed + 2])
    assert not scores.ended_by[scores.ticks < 2].size, text
    for run in (trace(rollout, seed), trace(rollout, seed + 1)):
        begin = tuple(run.begin)
        robot = Shape(*begin[:2], *[compiled.mind.body.kind.radius] * 2, is_round=True)
        things, boxes = [tuple(each) for each in run.things], [tuple(box) for box in run.boxes]
        found = [*bodies(task, things, boxes), (robot, False)]
        assert not any(a.covers(b) for (a, one), (b, other) in combinations(found, 2) if not (one and other)), text
        sides = task.scene.sides
        assert all(abs(v) + robot.half_x <= side / 2 + LITTLE for v, side in zip(begin[:2], sides, strict=True)), text
        ended = {end.event.thing for end in task.ends if end.event and end.event.outcome == "reached"}
        assert not decided(compiled.mind, things, begin) & ended, text


@settings(max_examples=cases(150), deadline=None)
@given(worlds())
def test_check_says_of_places_what_geometry_says(text: str) -> None:
    """An error where two are in one place with their least sizes, a finding where they are so with their largest."""
    compiled = compile_source(Source("hall.mind", text))
    codes = {diagnostic.code for diagnostic in compiled.diagnostics}
    if any(a.covers(b) for a, b in combinations(placed(text, 0), 2)):
        assert codes & {"same-place", "inside-obstacle"}, text
    else:
        assert "same-place" not in codes, text
    if compiled.graph and any(a.covers(b) for a, b in combinations(placed(text, 1), 2)):
        assert lint(compiled, ["chance-meeting"]), text


def placed(text: str, most: int) -> list[Shape]:
    """The bodies that lines of a text put at places, and the robot."""
    found = []
    starts = next((line.split()[2:4] for line in text.splitlines() if "starts at" in line), None)
    if starts or "in plain" in text:
        half = float(text.split("disc size ")[1].split()[0]) / 2
        found.append(Shape(*map(float, starts or (0, 0)), half, half, is_round=True))
    for words in (line.split() for line in text.splitlines() if " at " in line and " size " in line):
        if words[3] not in ("item", "box", "ball", "walker"):
            continue
        said, numbers = words[words.index("size") + 1 :], words[words.index("at") + 1 :]
        first = float(said[0])
        sizes = (first, first) if "by" in said else sorted((first, float(said[2]) if said[1] == "to" else first))
        places = " ".join(numbers).split(" to ")
        half = sizes[most] / 2
        found += [Shape(*map(float, place.split()), half, half, words[3] != "box") for place in places]
    return found
