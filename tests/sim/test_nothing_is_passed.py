"""Nothing solid is passed between two ticks: random worlds of any size, with robots of any speed in them."""

from collections import Counter
from dataclasses import replace
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Start, Thing
from mindrun.graph.policy import Policy
from mindrun.graph.tasks import things_of
from mindrun.kinds.things.map import Map
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from numpy.typing import NDArray

from tests.draws import first
from tests.sim.following import follow
from tests.sim.minds import compile_text
from tests.sim.swift_worlds import swift_world

Place = NDArray[np.float64]
OUTSIDE = 1e-9  # of a wall or of the arena, in units


def passed(rollout: Rollout, seed: int, seen: Counter[str]) -> list[str]:
    """What has come through something solid in a run, or stands in it; `seen` counts what there was to see."""
    run, half = trace(rollout, seed), np.array(rollout.task.scene.sides) / 2
    kinds = [thing.kind for thing in things_of(rollout.task)]
    before = [run.begin[:2], *(place[:2] for place in run.things)]
    was_inside = [is_inside(run.boxes, half, place) for place in before]  # where there was no room, and may get out
    found, least = [], min(rollout.graph.body.front, rollout.graph.body.side)
    pose, held = run.begin, -1
    for moment in run.moments:
        now = [moment.body[:2], *(place[:2] for place in moment.things)]
        for i, (begin, end) in enumerate(zip(before, now, strict=True)):
            inside = is_inside(run.boxes, half, end)
            ways = [[begin, end]]
            if i > 0 and moment.held == i - 1 != held:  # by way of where the claw was, before that moved
                ahead = rollout.graph.body.front + kinds[i - 1].largest / 2
                ways += [[begin, pose[:2] + ahead * np.array([np.cos(pose[2]), np.sin(pose[2])]), end]]
            is_barred = all(any(crosses(run.boxes, *leg) for leg in pairwise(way)) for way in ways)
            if not was_inside[i] and (inside or is_barred):
                found.append(f"{kinds[i - 1] if i else 'robot'} from {begin} to {end} in tick {moment.tick}")
            was_inside[i] &= inside
            seen["a thing that moves"] += i > 0 and bool((begin != end).any())
        seen["something held"] += moment.held >= 0
        seen["a contact"] += moment.touching
        seen["a leap"] += bool(np.abs(now[0] - before[0]).max() > 2 * least)
        before, pose, held = now, moment.body, moment.held
    return found


def is_inside(boxes: Place, half: Place, place: Place) -> bool:
    """Whether a point is in something solid, or outside of the arena."""
    depth = boxes[:, 2:] - np.abs(boxes[:, :2] - place)
    return bool((np.abs(place) > half + OUTSIDE).any() or (depth.min(axis=1, initial=np.inf) > OUTSIDE).any())


def crosses(boxes: Place, begin: Place, end: Place) -> bool:
    """Whether the straight way between two places leads through something solid, a fiftieth smaller."""
    with np.errstate(all="ignore"):
        sides = (boxes[:, None, :2] + np.array([[-0.98], [0.98]]) * boxes[:, None, 2:] - begin) / (end - begin)
    enter, leave = np.nanmax(sides.min(axis=1), axis=1), np.nanmin(sides.max(axis=1), axis=1)
    return bool(((enter < leave) & (leave > 0) & (enter < 1)).any())


def blocks(count: int, size: int) -> list[object]:
    """So many blocks of so many seeds each; all but the first two are of the slow tests."""
    return [pytest.param(i * size, marks=[pytest.mark.slow] if i > 1 else []) for i in range(count)]


@pytest.mark.parametrize("first", blocks(250, 40))
def test_nothing_is_passed(first: int) -> None:
    seen = Counter[str]()
    for seed in range(first, first + 40):
        rollout = Rollout(Policy(swift_world(Random(seed), 60), {}), "World", "Go")
        assert passed(rollout, seed, seen) == [], seed
    assert len(seen) == 4
    assert min(seen.values()) > 20


@pytest.mark.parametrize("seed", first(6, range(16)))
def test_swift_worlds_are_what_plain_pymunk_says(seed: int) -> None:
    """In as many strides, bit for bit."""
    graph = swift_world(Random(seed), 40)
    follow(Rollout(Policy(graph, {}), "World", "Go"), Engine(Policy(graph, {})), seed)


AHEAD = """
tick TICK s
master Go
body Robot is disc size SIZE
actuator left_wheel is wheel side left neutral 0.5 thrust THRUST
actuator right_wheel is wheel side right neutral 0.5 thrust THRUST
actuator claw is gripper neutral 0 reach 4
skill Go is rule
  drives left_wheel at 1
  drives right_wheel at 1
  drives claw at 1
task World in arena size 40
  starts at -10 0 facing 0 deg
  lasts 100 ticks
  rewards 1 per tick
  counts collision
"""


def ahead(tick: str, size: float, thrust: float, *things: str) -> Rollout:
    """A robot that drives from the left to the right, whatever it meets."""
    text = AHEAD.replace("TICK", tick).replace("SIZE", f"{size}").replace("THRUST", f"{thrust}")
    graph = compile_text(text + "".join(f"  contains {thing}\n" for thing in things))
    return Rollout(Policy(graph, {}), "World", "Go")


@pytest.mark.parametrize(
    ("tick", "size", "thrust"),
    [("1/20", 2, 600), ("1/10", 2, 600), ("1/60", 0.2, 80), ("1", 1, 1e5), ("1/5", 0.01, 1e6)],
)
def test_a_robot_stops_at_a_thin_wall_and_has_run_into_it_once(tick: str, size: float, thrust: float) -> None:
    rollout = ahead(tick, size, thrust, "fence is wall from 5 -20 to 5 20 thickness 0.02")
    run = trace(rollout, 1)
    moments = list(run.moments)
    assert 5 - size / 2 - 0.1 < moments[-1].body[0] < 5 - size / 4
    assert run.jobs.counts[0, 0] == 1


def test_a_robot_that_meets_nothing_goes_as_far_in_many_strides_as_in_one() -> None:
    """Beside a wall, and where there is none."""
    ends = [
        list(trace(ahead("1/20", 0.5, 20, *things), 1).moments)[20].body
        for things in ([], ["fence is wall from -9 0.6 to 20 0.6 thickness 0.2"])
    ]
    assert abs(ends[0] - ends[1]).max() < 1e-9
    assert ends[0][0] > 0


@pytest.mark.parametrize("size", [0.2, 1.0, 3.0])
def test_between_squares_that_touch_in_a_corner_there_is_no_way(size: float) -> None:
    base = ahead("1/20", size, 80 * size, "coin is item").graph
    maze = Thing("maze", Map((".#", "#."), 4.0))
    task = replace(base.tasks[0], things=(maze,), start=Start((-8.0, 8.0), -np.pi / 4))
    moments = list(trace(Rollout(Policy(replace(base, tasks=(task,)), {}), "World", "Go"), 1).moments)
    assert all(moment.body[0] < 0 < moment.body[1] for moment in moments)
    assert moments[-1].touching


def test_what_lies_behind_a_wall_is_not_taken() -> None:
    coin = "coin is item size 1 at 6 0"
    held = [[moment.held for moment in trace(ahead("1/20", 2, 80, coin, *walls), 1).moments] for walls in ([], [FENCE])]
    assert held[0][-1] == 0
    assert set(held[1]) == {-1}


FENCE = "fence is wall from 4 -20 to 4 20 thickness 0.1"


@pytest.mark.parametrize("density", [0.01, 100])
@pytest.mark.parametrize("kind", ["ball", "box"])
def test_what_is_pressed_against_a_thin_wall_stays_on_its_side(kind: str, density: float) -> None:
    """By a robot that goes on pushing."""
    rollout = ahead("1/30", 2, 1e4, f"thing is {kind} size 0.5 density {density} at 3 0.1", FENCE)
    moments = list(trace(rollout, 1).moments)
    assert max(max(moment.things[0, 0], moment.body[0]) for moment in moments) < 4
    assert max(moment.body[0] for moment in moments) > 1
