"""What the lanes do where random worlds seldom go: sums that overflow, an item behind, ends, ties, contacts left."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pymunk
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Actuator, Edge, End, Reward, Sensor, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.kinds.actuators.actuator import Gripper, Wheel
from mindrun.kinds.events.event import Reach, Visit
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.memory import Cell
from mindrun.kinds.scenes.scene import Arena, Plain
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.derived import Derivative
from mindrun.kinds.sensors.nearest import Bearing
from mindrun.kinds.sensors.rays import RangeFinder
from mindrun.kinds.sensors.waves import Sine
from mindrun.kinds.things.loose import LooseBox
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item, Power, Zone
from mindrun.numbers.arithmetic import in_claw, uniform
from mindrun.numbers.quantity import Span
from mindrun.sim.lanes.step import CONTACT_TICKS
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.hierarchies import doubling
from tests.minds import CLAW, always, mind, rule, skill
from tests.sim.following import follow
from tests.sim.minds import compile_text

NOBODY = np.zeros((1, 0), np.float32)


def task(ticks: int = 3, **changes: object) -> Task:
    empty = Task("World", Plain(), (), ticks, (), (), (), (Reward("", (("number", 1.0),), None),), ())
    return replace(empty, **changes)


@pytest.mark.parametrize("sent", [1.0, 0.0])
@pytest.mark.parametrize("levels", [127, 128, 129, 140])
def test_influence_that_overflows_is_a_fault_here_too(levels: int, sent: float) -> None:
    """One more skill below the last pair, and a memory: infinity times 0 is no number, and goes on down."""
    last = 2 * levels + 1
    skills = doubling(levels, (always("skill", last, sent), always("actuator", 0, sent), always("memory", 0, sent)))
    below = rule("Below", always("actuator", 1, 1.0))
    graph = replace(mind(*skills, below, cells=(Cell(0.5, 0.25),)), tasks=(task(),))
    engine = Engine(Policy(graph, {}))
    follow(Rollout(Policy(graph, {}), "World", "S0"), engine, 1)
    assert (engine.faults > 0) == (levels >= (128 if sent else 129))


@pytest.mark.parametrize(
    ("weights", "faults"), [((np.finfo(np.float32).max,), 0), ((3.401e38,), 0), ((2e38, 1.4e38), 0), ((3e38, 1e38), 3)]
)
def test_every_float32_is_a_number_up_to_the_largest(weights: tuple[float, ...], faults: int) -> None:
    """Of what is sent: one that is none is a fault."""
    top = skill("Top", Mlp(0), (0,) * len(weights), ("actuator", 0))
    full = Sensor("charge", Battery(start=1.0, drain=0.0), 0, 1)
    graph = replace(mind(top), sensors=(full,), tasks=(task(),))
    given = {"Top": np.array(weights, np.float32)}
    engine = Engine(Policy(graph, given))
    follow(Rollout(Policy(graph, given), "World", "Top"), engine, 1)
    assert engine.faults == faults


def as_python(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function of the lanes before it is compiled: what is compiled cannot be called from here."""
    return getattr(function, "py_func", function)


def at(x: float, y: float, size: float, heading: float = 0.0) -> bool:
    """Whether a thing there is in the claw of a robot of radius 1 in the origin, whose reach is 1.5."""
    body, things = np.zeros((6, 1)), np.array([[x], [y], [size], [0.0]])
    return bool(in_claw(body, np.array([[np.cos(heading)], [np.sin(heading)]]), things, 1.0, 1.5, 0, 0))


def test_the_claw_takes_what_is_ahead_of_it() -> None:
    """The claw's place is on the rim; half an item's size counts as reach."""
    assert at(1.0, 0.0, 1.0)
    assert at(2.9, 0.0, 1.0)
    assert not at(3.1, 0.0, 1.0)
    assert at(1.0, 1.9, 1.0)
    assert not at(1.0, 2.1, 1.0)
    assert at(2.4, 1.4, 1.0)
    assert not at(2.5, 1.5, 1.0)
    assert at(0.0, 1.5, 1.0, np.pi / 2)


@pytest.mark.parametrize("aside", [0.0, 0.6, -0.6])
def test_the_claw_takes_nothing_behind_its_place(aside: float) -> None:
    assert not at(0.9, aside, 1.0)
    assert not at(0.0, aside, 1.0)
    assert not at(-1.0, aside, 1.0)
    assert not at(1.5, 0.0, 1.0, np.pi)


def wheels(left: float, right: float, **options: object) -> tuple[Actuator, Actuator]:
    return Actuator("l", Wheel("left", left, **options)), Actuator("r", Wheel("right", right, **options))


def test_an_item_behind_is_never_taken() -> None:
    """It lies beside the robot, which turns until it is ahead: taken then, and only then."""
    taken = 0
    for seed in range(12):
        things = (Thing("object", Item(Span(1.0, 1.0), away=Span(1.7, 1.7))),)
        still = mind(rule("Top"), actuators=(*wheels(0.4, 0.6), Actuator("claw", Gripper(0.9))))
        graph = replace(still, tasks=(task(60, things=things),))
        run = trace(Rollout(Policy(graph, {}), "World", "Top"), seed)
        x, y, angle = run.begin
        for moment in run.moments:
            bearing = np.arctan2(run.things[0, 1] - y, run.things[0, 0] - x) - angle
            ahead = 1.7 * np.cos(bearing) - 1.0
            if moment.held == 0:
                assert ahead >= -1e-9
                taken += 1
                break
            assert ahead < 0 or abs(1.7 * np.sin(bearing)) > 1.9
            angle = moment.body[2]
    assert taken > 3


def test_the_first_event_that_ends_a_run_is_the_one_that_is_told() -> None:
    """Two in one tick: the first in the order of the task."""
    things = (
        Thing("home", Zone(Span(9.0, 9.0), away=Span(0.0, 1.0))),
        Thing("plug", Power(Span(9.0, 9.0), away=Span(0.0, 1.0))),
    )
    events = (Reach("plug"), Reach("home"))
    for ends, first in (((End(0), End(1)), 0), ((End(1), End(0)), 0), ((End(1, 2), End(1)), 1)):
        graph = replace(mind(rule("Top")), tasks=(task(9, things=things, events=events, ends=ends, counts=(0, 1)),))
        scores = Rollout(Policy(graph, {}), "World", "Top").score(NOBODY, range(20))
        together = (scores.by_event == 1).all(axis=2) & (scores.ticks == 1)
        assert together.any()
        assert (scores.ended_by[together] == first).all()


def test_lanes_that_close_ranks_keep_what_waits() -> None:
    """Runs end one by one, in other lanes than they began: with delays a result still depends on its seed alone."""
    base = mind(
        rule(
            "Top",
            Edge("actuator", 0, None, (("reading", 0), ("number", 3.0), ("*", 0))),
            Edge("actuator", 1, None, (("number", 1.0), ("reading", 0), ("-", 0))),
            reads=(0,),
        ),
        actuators=wheels(0.2, 0.9, delay=9),
    )
    bearing = replace(base.sensors[0], kind=Bearing("object", noise=0.1, every=2, delay=3))
    things = (
        Thing("object", Item(Span(3.0, 3.0), away=Span(3.0, 9.0))),
        Thing("rock", Obstacle(Span(1.0, 2.0), count=5)),
    )
    events = (Visit("patch", 3.0), Reach("object"))
    rewards = (Reward("", (("number", 1.0),), 0), Reward("", (("reading", 0),), None))
    world = task(300, scene=Arena(30.0), things=things, events=events, ends=(End(1),), rewards=rewards, counts=(0,))
    graph = replace(base, sensors=(bearing,), tasks=(world,))
    seeds = list(range(80))
    alone = Rollout(Policy(graph, {}), "World", "Top", lanes=1).score(NOBODY, seeds)
    assert len(np.unique(alone.ticks)) > 5
    together = Rollout(Policy(graph, {}), "World", "Top", lanes=32).score(NOBODY, seeds)
    np.testing.assert_array_equal(alone.by_line, together.by_line)
    np.testing.assert_array_equal(alone.ticks, together.ticks)


RUNNER = """
tick 1/20 s
master Run
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 3000
actuator right_wheel is wheel side right neutral 0.5 thrust 3000
sensor beat is sine period 3 s
skill Run is rule
  reads beat
  drives left_wheel at 1
  drives right_wheel at 1
task World in arena size 300
  contains rock is obstacle grid 12 size 2 to 4
  lasts 30 ticks
  rewards 1 on collision
"""


def test_a_robot_that_leaps_meets_what_stands_where_it_arrives() -> None:
    """In every direction: one that is faster than its choice of boxes leaves it in a single tick."""
    graph, directions, touched = compile_text(RUNNER), set(), 0
    for seed in (0, 1, 2, 5, 11, 13):
        rollout = Rollout(Policy(graph, {}), "World", "Run")
        directions.add(int(trace(rollout, seed).begin[2] % (2 * np.pi) // (np.pi / 2)))
        touched += follow(rollout, Engine(Policy(graph, {})), seed)["Collision"]
    assert directions == {0, 1, 2, 3}
    assert touched > 10


@pytest.mark.parametrize("seed", range(8))
def test_a_robot_meets_the_wall_that_its_next_step_reaches(seed: int) -> None:
    """In ticks of four seconds its step is four times its speed, and still too short to be a leap."""
    text = RUNNER.replace("tick 1/20 s", "tick 4 s").replace("thrust 3000", "thrust 7.4").replace("size 300", "size 60")
    graph = compile_text(text.replace("  contains rock is obstacle grid 12 size 2 to 4\n", ""))
    happened = follow(Rollout(Policy(graph, {}), "World", "Run"), Engine(Policy(graph, {})), seed)
    assert happened["Collision"] > 0


@pytest.mark.parametrize("away", [1, 2, 3, 4, 5, 7])
def test_a_contact_that_was_left_is_forgotten_as_chipmunk_forgets(away: int) -> None:
    """A robot that slides along rocks and comes back after some ticks: as if Chipmunk had stepped all the time."""
    assert pymunk.Space().collision_persistence < CONTACT_TICKS
    push = mind(rule("Top"), actuators=wheels(0.9, 0.75))
    things = (Thing("rock", Obstacle(Span(1.0, 3.0), grid=3.5, jitter=0.5)),)
    wave = replace(push.sensors[0], kind=Sine((4 + 3 * away) / 60))
    drive = rule(
        "Top",
        Edge("actuator", 0, None, (("reading", 0), ("number", 2.0), ("*", 0), ("number", 0.3), ("-", 0))),
        Edge("actuator", 1, None, (("reading", 0), ("number", 1.5), ("*", 0), ("number", 0.1), ("-", 0))),
        reads=(0,),
    )
    graph = replace(push, sensors=(wave,), skills=(drive,), tasks=(task(400, scene=Arena(20.0), things=things),))
    follow(Rollout(Policy(graph, {}), "World", "Top"), Engine(Policy(graph, {})), away)


def test_each_reading_of_a_wide_sensor_has_a_derivative_of_its_own() -> None:
    eyes = Sensor("eyes", RangeFinder(at=(0.0, 1.0, 3.0)), 0, 3)
    change = Sensor("change", Derivative("eyes", 4.0), 3, 3)
    again = Sensor("again", Derivative("change", 40.0), 6, 3)
    drive = rule("Top", Edge("actuator", 0, None, (("reading", 4), ("reading", 8), ("+", 0))), reads=tuple(range(9)))
    things = (Thing("rock", Obstacle(Span(1.0, 3.0), grid=5.0, jitter=0.5)),)
    base = mind(drive, actuators=wheels(0.9, 0.7))
    graph = replace(base, sensors=(eyes, change, again), tasks=(task(60, scene=Arena(20.0), things=things),))
    follow(Rollout(Policy(graph, {}), "World", "Top"), Engine(Policy(graph, {})), 2)


@pytest.mark.parametrize("scene", [Plain(), Arena(60.0)])
def test_everything_is_placed_clear_of_everything(scene: Plain | Arena) -> None:
    """As far from the robot as is said, with its width free around obstacles, nothing on anything, all inside."""
    things = (
        Thing("stone", Obstacle(Span(1.0, 4.0), count=4, away=Span(5.0, 25.0))),
        Thing("object", Item(Span(1.0, 3.0), away=Span(6.0, 12.0))),
        Thing("home", Zone(Span(4.0, 4.0))),
        Thing("coin", Item(Span(2.0, 2.0), away=Span(8.0, 9.0))),
    )
    graph = replace(mind(rule("Top"), actuators=(CLAW,)), tasks=(task(1, scene=scene, things=things),))
    spans = [(6.0, 12.0), (10.0, np.inf if isinstance(scene, Arena) else 40.0), (8.0, 9.0)]
    angles, places, sizes = [], [], []
    for seed in range(40):
        run = trace(Rollout(Policy(graph, {}), "World", "Top"), seed)
        x, y, angle = run.begin
        angles.append(angle)
        places.append(abs(x))
        far = np.hypot(run.things[:, 0] - x, run.things[:, 1] - y)
        assert all(low <= d <= high for d, (low, high) in zip(far, spans, strict=True))
        rocks = np.hypot(run.boxes[:, 0] - x, run.boxes[:, 1] - y)
        assert ((rocks >= 5.0) & (rocks <= 25.0)).all()
        squares = [(*box[:3], 2.0) for box in run.boxes] + [(*t[:2], t[2] / 2, 0.0) for t in run.things]
        for i, (ax, ay, a, margin) in enumerate(squares):
            for bx, by, b, _ in squares[i + 1 :]:
                assert max(abs(ax - bx), abs(ay - by)) >= a + b + margin
            if isinstance(scene, Arena):
                assert max(abs(ax), abs(ay)) <= 30.0 - a - 2.0 + 1e-9
        assert ((run.boxes[:, 2] >= 0.5) & (run.boxes[:, 2] <= 2.0)).all()
        assert 1.0 <= run.things[0, 2] <= 3.0
        sizes.append((*run.boxes[:, 2] * 2, run.things[0, 2]))
    assert (np.min(sizes, axis=0) < 1.4).all()
    assert (np.max(sizes, axis=0) > (3.6, 3.6, 3.6, 3.6, 2.6)).all()
    assert min(angles) < 1.0
    assert max(angles) > 5.0
    assert (max(places) == 0) == isinstance(scene, Plain)
    assert max(places) <= 27.0


def test_where_not_all_finds_a_place_the_robot_has_its_own() -> None:
    """More stones than fit with the robot's width between crowd each other, and never the robot."""
    things = (Thing("stone", Obstacle(Span(3.0, 6.0), count=20)), Thing("object", Item(Span(2.0, 2.0))))
    graph = replace(mind(rule("Top"), actuators=(CLAW,)), tasks=(task(1, scene=Arena(40.0), things=things),))
    crowded = 0
    for seed in range(100):
        run = trace(Rollout(Policy(graph, {}), "World", "Top"), seed)
        gaps = np.abs(run.boxes[:, None, :2] - run.boxes[None, :, :2]).max(axis=2)
        gaps += np.diag(np.full(len(gaps), np.inf))
        crowded += bool((gaps < run.boxes[:, 2] + run.boxes[:, None, 2]).any())
        assert (np.abs(run.boxes[:, :2] - run.begin[:2]).max(axis=1) >= run.boxes[:, 2] + 3.0).all()
        assert np.hypot(*(run.things[0, :2] - run.begin[:2])) >= 10.0
    assert crowded > 30


def test_no_obstacle_stands_on_what_has_a_place() -> None:
    things = (
        Thing("stone", Obstacle(Span(3.0, 4.0), count=4)),
        Thing("dock", Zone(Span(9.0, 9.0), at=((8.0, 5.0),))),
        Thing("crate", LooseBox(Span(3.0, 3.0), at=((-10.0, -10.0),))),
    )
    graph = replace(mind(rule("Top")), tasks=(task(1, scene=Arena(60.0), things=things),))
    for seed in range(60):
        boxes = trace(Rollout(Policy(graph, {}), "World", "Top"), seed).boxes
        assert (np.abs(boxes[:, :2] - [8.0, 5.0]).max(axis=1) >= 4.5 + boxes[:, 2]).all()
        assert (np.abs(boxes[:, :2] + 10.0).max(axis=1) >= 1.5 + boxes[:, 2]).all()


def test_things_of_any_size_stand_beside_each_other() -> None:
    """The small and the large, as close as they come."""
    sizes = (0.5, 9.0, 1.0, 7.0, 2.0)
    things = tuple(Thing(f"t{i}", Zone(Span(size, size), away=Span(6.0, 14.0))) for i, size in enumerate(sizes))
    graph = replace(mind(rule("Top")), tasks=(task(1, things=things),))
    closest = np.inf
    for seed in range(40):
        places = trace(Rollout(Policy(graph, {}), "World", "Top"), seed).things
        for i, a in enumerate(places):
            for b in places[i + 1 :]:
                gap = np.abs(a[:2] - b[:2]).max() - (a[2] + b[2]) / 2
                assert gap >= 0
                closest = min(closest, gap)
    assert closest < 0.2


def test_a_grid_stands_on_its_crossings() -> None:
    """Strictly inside the arena, each off by no more than the jitter along both axes."""
    for jitter in (0.0, 1.0):
        things = (Thing("rock", Obstacle(Span(1.0, 2.0), grid=10.0, jitter=jitter)),)
        graph = replace(mind(rule("Top")), tasks=(task(1, scene=Arena(40.0), things=things),))
        run = trace(Rollout(Policy(graph, {}), "World", "Top"), 3)
        crossings = np.array([(x, y) for y in (-10.0, 0.0, 10.0) for x in (-10.0, 0.0, 10.0)])
        off = run.boxes[:, :2] - crossings
        assert np.abs(off).max() <= jitter
        assert (off.min() < -jitter / 2) == (off.max() > jitter / 2) == (jitter > 0)
        halves = run.boxes[:, 2]
        assert 0.5 <= halves.min() < 0.7 < 0.8 < halves.max() <= 1.0
        gaps = np.abs(run.boxes[:, :2] - run.begin[:2]).max(axis=1) - run.boxes[:, 2]
        assert gaps.min() >= 3.0


def test_the_numbers_of_a_world_are_splitmix64() -> None:
    """Seeded by the layout: what the algorithm's authors give for seed 1234567."""
    random = np.array([1234567], np.uint64)
    with np.errstate(over="ignore"):
        drawn = [as_python(uniform)(random, 0, 0.0, 1.0) for _ in range(3)]
    expected = [6457827717110365317, 3203168211198807973, 9817491932198370423]
    assert drawn == [(number >> 11) * 2.0**-53 for number in expected]
