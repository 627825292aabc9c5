"""Several things of one name: a sensor speaks of the nearest, or of any of them; what has vanished is not there."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.graph import Reward, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.graph.tasks import things_of
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.sensors.contact import Contact, Held, Inside
from mindrun.kinds.sensors.nearest import Bearing
from mindrun.kinds.things.map import Map
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item, ThingKind, Zone
from mindrun.kinds.things.wall import Wall
from mindrun.numbers.arithmetic import DISTANCE, HALF_X, THING_ROWS, nearest
from mindrun.numbers.quantity import Span
from mindrun.sim.numbering import boxes_by_name, rows_by_name
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.minds import always, mind, rule
from tests.sensors.plain_lanes import plain_lane

AWAY = st.sampled_from([0.0, 1.0, 1.0, 2.0, 3.0, np.nan])


@dataclass(frozen=True)
class Several(Item):
    """Three items of one name."""

    copies = 3  # type: ignore[assignment]


def state(distances: list[float], things: int, first: int = 0, count: int | None = None) -> tuple[SimpleNamespace, ...]:
    """A lane with things that far away, each with its number as its place; and a sensor of `count` from `first` on."""
    rows = np.repeat(np.arange(things, dtype=float), THING_ROWS)[:, None].copy()
    rows[DISTANCE::THING_ROWS, 0] = distances
    lanes = SimpleNamespace(
        things=rows, nearest=np.zeros((THING_ROWS, 1)), nearest_of=np.array([-1]),
        readings=np.zeros((1, 1), np.float32), held=np.array([-1]),
        body=np.zeros((6, 1)), heading=np.array([[1.0], [0.0]]),
    )  # fmt: skip
    return lanes, SimpleNamespace(
        thing=first, things=things - first if count is None else count, boxes=0, start=0, gain=0
    )


@given(st.lists(AWAY, min_size=1, max_size=6), st.data())
def test_the_nearest_is_the_first_of_the_least_distances(distances: list[float], data: st.DataObject) -> None:
    first = data.draw(st.integers(0, len(distances) - 1))
    lanes, sensor = state(distances, len(distances), first)
    found = nearest(lanes, sensor, 1)[:, 0]
    there = [i for i in range(first, len(distances)) if not np.isnan(distances[i])]
    if there:
        assert found[0] == min(there, key=lambda i: distances[i])
    else:
        assert np.isnan(found[DISTANCE])


def test_what_has_copies_has_as_many_rows() -> None:
    things = Thing("home", Zone()), Thing("rock", Obstacle(count=2)), Thing("gem", Several()), Thing("coin", Item())
    task = Task("World", Arena(), things, 1, (), (), (), (), ())
    assert [thing.name for thing in things_of(task)] == ["home", "gem", "gem", "gem", "coin"]
    assert rows_by_name(task) == {"": range(-1, -1), "home": range(1), "gem": range(1, 4), "coin": range(4, 5)}
    assert ThingKind.copies.fget(Item()) == 1  # type: ignore[attr-defined]


def test_what_is_solid_has_the_boxes_that_are_drawn_for_it() -> None:
    """Each name is told by the size of its boxes, wherever it stands among the others."""
    things = (
        Thing("stone", Obstacle(Span(3.0, 3.0), count=2)), Thing("rock", Obstacle(Span(1.0, 1.0), grid=15.0)),
        Thing("gem", Item()), Thing("fence", Wall(((-9.0, 5.0), (9.0, 5.0), (9.0, 9.0)), 0.5)),
        Thing("block", Obstacle(Span(2.0, 2.0), at=((0.0, -9.0), (7.0, -9.0)))), Thing("none", Obstacle(grid=90.0)),
        Thing("maze", Map(("#.", "..", ".#"), 1.25)),
    )  # fmt: skip
    graph = replace(mind(rule("Top", always("actuator", 0, 0.9))), tasks=(world := Task(
        "World", Arena(40.0), things, 9, (), (), (), (Reward("", (("number", 1.0),), None),), ()),))  # fmt: skip
    boxes = trace(Rollout(Policy(graph, {}), "World", "Top"), 3).boxes
    found = boxes_by_name(world)
    thin = {name: {2 * min(box[HALF_X:]) for box in boxes[rows.start : rows.stop]} for name, rows in found.items()}
    assert thin == {"stone": {3.0}, "rock": {1.0}, "fence": {0.5}, "block": {2.0}, "none": set(), "maze": {1.25}}
    assert sum(map(len, found.values())) == len(boxes) == 2 + 4 + 2 + 2 + 2


def test_it_is_held_where_one_of_its_name_is() -> None:
    for held in range(-1, 6):
        lanes, sensor = state([1.0] * 6, 6, 2, 3)
        lanes.held[0] = held
        plain_lane(Held.lane)(None, lanes, 1, 0, sensor)
        assert lanes.readings[0, 0] == (held in (2, 3, 4))


def test_it_is_inside_and_in_contact_where_one_of_its_name_is() -> None:
    world = SimpleNamespace(world=[SimpleNamespace(radius=1.0, front=1.0, claw=1.5)])
    for near in range(6):
        lanes, sensor = state([1.0] * 6, 6, 2, 3)
        lanes.things[:] = 50.0
        lanes.things[THING_ROWS * near : THING_ROWS * near + 3, 0] = 2.0, 0.0, 6.0
        for kind in (Inside, Contact):
            plain_lane(kind.lane)(world, lanes, 1, 0, sensor)
            assert lanes.readings[0, 0] == (near in (2, 3, 4))


def test_a_bearing_points_to_the_nearest_within_range() -> None:
    lanes, _ = state([9.0, 2.0, 4.0], 3)
    lanes.things[0::THING_ROWS, 0], lanes.things[1::THING_ROWS, 0] = (9.0, 0.0, -4.0), (0.0, 2.0, 0.0)
    sensor = SimpleNamespace(thing=0, things=3, boxes=0, start=0, gain=0, range=3.0, dead_zone=np.float32(0))
    plain_lane(Bearing.lane)(None, lanes, 1, 0, sensor)
    assert lanes.readings[0, 0] == np.float32(0.25)
    sensor.range = 1.9
    plain_lane(Bearing.lane)(None, lanes, 1, 0, sensor)
    assert lanes.readings[0, 0] == 0.5


@pytest.mark.parametrize("turns", [-0.45, -0.2, -0.09, 0.0, 0.09, 0.2, 0.45])
def test_a_bearing_in_the_dead_zone_is_straight_ahead(turns: float) -> None:
    lanes, sensor = state([2.0], 1)
    lanes.things[:2, 0] = 2 * np.cos(2 * np.pi * turns), 2 * np.sin(2 * np.pi * turns)
    plain_lane(Bearing.lane)(None, lanes, 1, 0, SimpleNamespace(**vars(sensor), range=3.0, dead_zone=np.float32(0.1)))
    assert lanes.readings[0, 0] == pytest.approx(0.5 if abs(turns) < 0.1 else 0.5 - turns, abs=1e-6)
