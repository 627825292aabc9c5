"""A world drawn in plain Python is the one that the lanes draw: of the same random numbers the same places."""

from collections.abc import Iterator
from math import hypot
from random import Random

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Trace, trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.model import Task
from mindlang.compiler.source import Source
from mindlang.lint.rules.crowded_world import DrawnWorld

ROBOT = """
tick 1/20 s
master Go
body Robot is {body}
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
skill Go is rule
  drives left_wheel at 0.5
  drives right_wheel at 0.5
task Hall in {scene}
  lasts 2 ticks
  counts reach of goal
  succeeds on reach of goal
"""
GOAL = "  contains goal is item size 1\n"
STREWN = (
    "  contains rock is obstacle grid 9 size 1 to 2 jitter 1\n"
    "  contains stone is obstacle count 3 size 1 to 3\n"
    "  contains fence is wall from -9 -7 to 9 -7\n"
    "  contains home is zone size 3 at 8 -4\n"
    "  contains lair is zone size 3 to 4 away 4 to 9\n"
    "  contains crate is box size 1 to 2 count 2\n"
    "  contains puck is ball size 1\n"
)
AT = "  starts at 3 4 facing 0 deg\n"
FACED = "  starts facing 0 deg\n"
PLACED = {
    "strewn": ("arena size 40 32", "disc size 1.2", STREWN + GOAL + AT),
    "near the border": ("arena size 15 11", "disc size 1", "  contains crate is box size 1 to 3\n" + GOAL + AT),
    "without room": ("arena size 9 30", "box size 3 2", "  contains crate is box size 4 to 6\n" + GOAL + AT),
    "a goal on the floor": (
        "arena size 20", "disc size 1",
        "  contains goal is zone size 6 to 9\n  contains crate is box size 3 to 5\n" + AT,
    ),
    "a large robot": ("arena size 40", "disc size 6", "  contains stone is obstacle count 2 size 1 to 9\n" + GOAL + AT),
    "so far away": (
        "arena size 40", "disc size 1",
        "  contains stone is obstacle count 2 size 1 to 2 away 5 to 9\n  contains crate is box size 2 away 4 to 6\n"
        + GOAL + AT,
    ),
    "plain": (
        "plain", "disc size 2",
        "  contains stone is obstacle count 3 size 1 to 3 away 6 to 9\n"
        "  contains crate is box size 2 to 3 away 5 to 9\n"
        "  contains home is zone size 4 away 2 to 5\n" + GOAL + AT,
    ),
    "the middle of a plain": ("plain", "disc size 2", GOAL + FACED),
}  # fmt: skip
DRAWN = {
    "empty": ("arena size 20 14", "disc size 2", GOAL + FACED),
    "hardly any room": ("arena size 5 40", "disc size 2", "  contains goal is item size 1 at 0 15\n" + FACED),
    "strewn": ("arena size 40 32", "disc size 1.2", STREWN + GOAL + FACED),
    "a goal at a place": ("arena size 14", "disc size 1", "  contains goal is item size 1 at 0 0\n" + FACED),
    "a goal on the floor": ("arena size 14", "disc size 1", "  contains goal is zone size 5 at 2 0\n" + FACED),
    "a ball at a place": ("arena size 16", "disc size 2", "  contains goal is ball size 4 at 2 0\n" + FACED),
    "what is no goal": ("arena size 14", "disc size 1", GOAL + "  contains home is zone size 9 at 0 0\n" + FACED),
}


class SplitMix(Random):
    """The generator of a lane."""

    def __init__(self, seed: int) -> None:
        super().__init__(0)
        self.state = seed

    def uniform(self, a: float, b: float) -> float:
        """As `mindrun.sim.lanes.placement` has it."""
        self.state = (self.state + 0x9E3779B97F4A7C15) % 2**64
        z = self.state
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB % 2**64
        return a + (b - a) * (((z ^ (z >> 31)) >> 11) * 2.0**-53)


def both(case: tuple[str, str, str], seeds: range) -> Iterator[tuple[DrawnWorld, Trace, Task]]:
    """Worlds drawn here and there, but for those in which something finds no place soon."""
    scene, body, lines = case
    compiled = compile_source(Source("hall.mind", ROBOT.format(scene=scene, body=body) + lines))
    assert compiled.graph, [each.message for each in compiled.diagnostics]
    assert compiled.mind
    [task], claw = compiled.mind.tasks, compiled.graph.claw_reach
    rollout, body_kind = Rollout(Policy(compiled.graph, {}), "Hall", "Go"), compiled.mind.body.kind
    for seed in seeds:
        world = DrawnWorld(task.scene, body_kind, claw, frozenset({"goal"}), SplitMix(seed))
        if not world.draw(task):
            yield world, trace(rollout, seed), task


def assert_same_things(world: DrawnWorld, run: Trace) -> None:
    """All stands where the lanes have it; what has a place is listed before what has none here."""
    assert np.allclose(world.robot, run.begin[:2])
    boxes = sorted((each.x, each.y, each.half_x, each.half_y) for each in world.solid)
    assert np.allclose(boxes, sorted(map(tuple, run.boxes.tolist())))
    things = sorted((each.x, each.y, 2 * each.half_x) for each in world.things)
    assert np.allclose(things, sorted(map(tuple, run.things[:, :3].tolist())))


@pytest.mark.parametrize("case", PLACED.values(), ids=PLACED)
def test_all_is_where_the_lanes_have_it(case: tuple[str, str, str]) -> None:
    worlds = [*both(case, range(30))]
    assert len(worlds) > 15
    for world, run, _ in worlds:
        assert_same_things(world, run)


@pytest.mark.parametrize("case", DRAWN.values(), ids=DRAWN)
def test_the_robot_is_where_the_lanes_have_it_unless_they_have_found_more_room(case: tuple[str, str, str]) -> None:
    same = 0
    for world, run, task in both(case, range(40)):
        if np.allclose(world.robot, run.begin[:2]):
            assert_same_things(world, run)
            same += 1
        else:  # it is within its own width of something, where the lanes try again
            (x, y), kinds = world.robot, [each.kind for each in task.things if not each.kind.is_obstacle]
            solid = [(each.x, each.y, each.half_x, each.half_y) for each in world.solid]
            solid += [(*place, kind.largest / 2, kind.largest / 2) for kind in kinds for place in kind.places]
            nearest = min(max(abs(x - a) - half_x, abs(y - b) - half_y) for a, b, half_x, half_y in solid)
            assert world.body.radius - 1e-9 <= nearest < 3 * world.body.radius
    assert same > 10


def test_what_it_has_cost_is_counted() -> None:
    fence = "  contains fence is wall from -19 -19 to 19 -19\n  contains home is zone size 2 at 0 18\n"
    [(world, *_)] = both(
        ("arena size 40", "disc size 1", fence + GOAL + "  starts at 0 15 facing 0 deg\n"), range(3, 4)
    )
    assert world.looks == 2, "the fence and the zone, for the goal, of which the first try is clear"
    assert hypot(*world.robot) == 15
