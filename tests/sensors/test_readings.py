"""What sensors of places, speeds, light and touch read: by hand, and in compiled lanes the bits of plain Python."""

from dataclasses import dataclass, replace
from math import pi, prod
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph, Reward, Sensor
from mindrun.graph.policy import Policy
from mindrun.kinds.registry import kinds
from mindrun.kinds.sensors.bumper import Bumper
from mindrun.kinds.sensors.contact import Floor
from mindrun.kinds.sensors.motion import Odometer, Position, Speed, TurnRate
from mindrun.kinds.sensors.nearest import Bearing, Distance, Light
from mindrun.kinds.sensors.rays import Eye
from mindrun.kinds.sensors.sensor import Physical, SensorKind
from mindrun.kinds.sensors.waves import Clock
from mindrun.numbers.arithmetic import DISTANCE, FIRST_RAY, FRAME_ROWS, LOOSE_ROWS, THING_ROWS
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.rollout import Rollout

from tests.draws import cases
from tests.hierarchies import WORLDLY
from tests.minds import always, mind, rule
from tests.sensors.plain_lanes import plain_lane
from tests.sensors.test_constants import World
from tests.sim.worlds import random_world

F = np.float32
TICK = 1 / 60


@dataclass
class Place:
    """A robot of radius 1, or a rectangular one, in the origin facing east, one thing at a place, and boxes."""

    at: tuple[float, float] = (0.0, 0.0)
    size: float = 2.0
    is_round: bool = True
    boxes: tuple[tuple[float, float, float], ...] = ()
    angle: float = 0.0
    speeds: tuple[float, float, float] = (0.0, 0.0, 0.0)
    half: float = 50.0
    middle: tuple[float, float] = (0.0, 0.0)
    there: bool = True
    turned: float | None = None  # how far the thing is, if it is loose
    halves: tuple[float, float] | None = None  # of the sides of a rectangular robot
    of_boxes: bool = False  # whether the sensor is about the boxes
    ball: tuple[float, float, float] | None = None  # place and size of another thing that is loose
    crate: tuple[float, float, float, float] | None = None  # the same, and how far it is turned

    def reads(self, kind: Any) -> list[float]:
        """The readings of a sensor."""
        x, y = self.middle
        way = np.hypot(self.at[0] - x, self.at[1] - y)
        boxes = np.array([number for box in self.boxes for number in (*box, box[-1])])
        sight = np.full((FIRST_RAY + len(kind.rays), 1), F(40))
        sight[:FIRST_RAY, 0] = cosine(self.angle), sine(self.angle), x, y
        columns = [F(cosine(angle)) for angle in kind.rays], [F(sine(angle)) for angle in kind.rays]
        front, side = self.halves or (1.0, 1.0)
        outline = {"front": front, "side": side, "radius": np.hypot(front, side) if self.halves else 1.0}
        world = SimpleNamespace(**outline, is_round=not self.halves, half_x=self.half, half_y=self.half)
        there = self.turned is not None, self.ball is not None, self.crate is not None
        round_ = self.is_round, True, False
        loose = [SimpleNamespace(thing=i, is_round=round_[i]) for i in range(3) if there[i]]
        angles = self.turned or 0.0, 0.0, (self.crate or (0.0,))[-1]
        turns = [angle for angle, is_there in zip(angles, there, strict=True) if is_there]
        tables = SimpleNamespace(
            world=[world],
            things=[SimpleNamespace(is_round=self.is_round, loose=-1)],
            loose=loose,
            robots=[SimpleNamespace(thing=-1)],
            numbers=np.array(kind.numbers), rays=np.array(columns),
            rims=np.ones(len(kind.rays), F),
        )  # fmt: skip
        others = *(self.ball or (0.0, 0.0, 0.0)), 0.0, *(self.crate or (0.0, 0.0, 0.0))[:3], 0.0
        senses = SimpleNamespace(
            body=np.array([x, y, self.angle, *self.speeds])[:, None],
            heading=np.array([[cosine(self.angle)], [sine(self.angle)]]),
            things=np.array([*self.at, self.size, way, *others])[:, None], nearest=np.zeros((THING_ROWS, 1)),
            nearest_of=np.array([-1]), frame=np.zeros((FRAME_ROWS, 1), F),
            loose=np.repeat([*turns, 0.0], LOOSE_ROWS)[:, None],
            readings=np.zeros((prod(kind.shape), 1), F), boxes=boxes[None], nearby=boxes[:, None],
            nearby_count=[len(self.boxes)], sight=sight, tick=np.array([90]),
        )  # fmt: skip
        things, seen = int(self.there and not self.of_boxes), len(self.boxes) if self.of_boxes else 0
        row = {"start": 0, "width": prod(kind.shape), "thing": 0, "things": things, "box": 0, "boxes": seen}
        row |= {"ray": 0, "number": 0, "servo": -1}
        scene = SimpleNamespace(tick=TICK, starts={})
        with np.errstate(divide="ignore"):
            plain_lane(kind.lane)(tables, senses, 1, 0, SimpleNamespace(**row, **{"gain": 0.0, **kind.row(scene)}))
        return senses.readings[:, 0].tolist()


@pytest.mark.parametrize(
    ("kind", "place", "reads"),
    [
        (Distance("x", range=40.0), Place((10.0, 0.0)), [0.2]),
        (Distance("x", range=40.0), Place((0.0, 1.5)), [0.0]),
        (Distance("x", range=40.0), Place((42.0, 0.0)), [1.0]),
        (Distance("x", range=40.0), Place(there=False), [1.0]),
        (Distance("x"), Place((np.nan, np.nan)), [1.0]),
        (Distance("x", range=10.0), Place((7.5, 0.0), halves=(1.5, 1.0)), [0.5]),
        (Distance("x", range=10.0), Place((0.0, 7.0), halves=(1.5, 1.0)), [0.5]),
        (Distance("x", range=10.0), Place((0.0, 7.5), halves=(1.5, 1.0), angle=pi / 2), [0.5]),
        (Distance("x", range=10.0), Place((4.0, -4.0), halves=(1.5, 1.0)), [F(0.3 * 2**0.5 - 0.1)]),
        (Distance("x"), Place((0.5, 0.5), halves=(1.5, 1.0)), [0.0]),
        (Distance("x"), Place((0.0, 0.0), halves=(1.5, 1.0)), [0.0]),
        (Distance("x"), Place((np.nan, np.nan), halves=(1.5, 1.0)), [1.0]),
        (Light("x", range=10.0), Place((0.0, 0.0)), [1.0]),
        (Light("x", range=10.0), Place((0.0, 10.0)), [0.5]),
        (Light("x", range=10.0), Place((0.0, 30.0)), [0.1]),
        (Light("x", range=10.0), Place((10.0, 0.0), boxes=((5.0, 0.0, 1.0),)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 0.0), boxes=((5.0, 1.1, 1.0), (12.0, 0.0, 1.0))), [0.5]),
        (Light("x", range=10.0), Place((10.0, 10.0), boxes=((5.0, 2.9, 1.0),)), [F(1 / 3)]),
        (Light("x", range=10.0), Place((10.0, 10.0), boxes=((5.0, 4.0, 1.0),)), [0.0]),
        (Light("x"), Place((np.nan, np.nan)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(5.0, 1.1, 2.4)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(5.0, 1.3, 2.4)), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(11.3, 0.0, 2.4)), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(11.1, 0.0, 2.4)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(-1.3, 0.0, 2.4)), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(-1.1, 0.0, 2.4)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 0.0), ball=(np.nan, np.nan, 2.4)), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), turned=0.0), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), crate=(5.0, 1.3, 2.0, 0.0)), [0.5]),
        (Light("x", range=10.0), Place((10.0, 0.0), crate=(5.0, 1.3, 2.0, pi / 4)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 10.0), crate=(5.0, 3.1, 2.0, 0.0)), [0.0]),
        (Light("x", range=10.0), Place((10.0, 10.0), crate=(5.0, 3.1, 2.0, -pi / 4)), [F(1 / 3)]),
        (Light("x", range=10.0), Place((10.0, 0.0), crate=(np.nan, np.nan, 2.0, 0.0)), [0.5]),
        (Distance("x", range=10.0), Place(boxes=((7.0, 0.0, 1.0), (0.0, -4.0, 1.0)), of_boxes=True), [0.2]),
        (Distance("x", range=10.0), Place(boxes=((5.0, 6.0, 2.0),), of_boxes=True), [0.4]),
        (Distance("x", range=10.0), Place(boxes=((0.5, 0.0, 1.0),), of_boxes=True), [0.0]),
        (Distance("x", range=10.0), Place(boxes=((7.5, 0.0, 1.0),), of_boxes=True, halves=(1.5, 1.0)), [0.5]),
        (Bearing("x"), Place(boxes=((7.0, 0.0, 1.0), (0.0, -4.0, 1.0)), of_boxes=True), [0.75]),
        (Bearing("x"), Place(boxes=((9.0, 9.0, 2.0),), of_boxes=True, angle=pi / 2), [0.625]),
        (Bearing("x", range=2.9), Place(boxes=((0.0, -4.0, 1.0),), of_boxes=True), [0.5]),
        (Bearing("x"), Place(boxes=((0.5, 0.0, 1.0),), of_boxes=True), [0.5]),
        (Eye("x", at=(0.0, pi / 2), range=10.0), Place(boxes=((7.0, 0.5, 1.0),), of_boxes=True), [0.5, 1.0]),
        (Eye("x", at=(0.0,), range=90.0), Place(boxes=((60.0, 0.0, 1.0),), of_boxes=True), [1.0]),
        (Eye("x", at=(0.0,)), Place(boxes=((0.5, 0.0, 1.0),), of_boxes=True), [0.0]),
        (Light("x"), Place(there=False), [0.0]),
        (Eye("x", at=(0.0, pi / 2), range=16.0), Place((10.0, 0.0)), [0.5, 1.0]),
        (Eye("x", at=(0.0, pi / 2), range=16.0), Place((0.0, 10.0), is_round=False), [1.0, 0.5]),
        (Eye("x", at=(0.0,), range=16.0), Place((10.0, 0.0), angle=pi / 2), [1.0]),
        (Eye("x", at=(0.0,), range=16.0), Place((-10.0, 0.0)), [1.0]),
        (Eye("x", at=(0.0, 3.0), range=16.0), Place((0.3, 0.0), is_round=False), [0.0, 0.0]),
        (Eye("x", at=(0.0,), range=16.0), Place((10.0, 5.0), middle=(0.0, 5.0)), [0.5]),
        (Eye("x", at=(0.0,), range=90.0), Place((60.0, 0.0)), [1.0]),
        (Eye("x", at=(0.0,)), Place((np.nan, np.nan)), [1.0]),
        (TurnRate(range=2.0), Place(speeds=(0.0, 0.0, 1.0)), [0.25]),
        (TurnRate(range=2.0), Place(speeds=(0.0, 0.0, -3.0)), [1.0]),
        (TurnRate(range=2.0, dead_zone=0.3), Place(speeds=(0.0, 0.0, 1.0)), [0.5]),
        (Speed(range=4.0), Place(speeds=(2.0, 5.0, 0.0)), [0.75]),
        (Speed(range=4.0), Place(speeds=(-9.0, 0.0, 0.0)), [0.0]),
        (Speed(range=4.0, dead_zone=0.3), Place(speeds=(2.0, 5.0, 0.0)), [0.5]),
        (Odometer("left", range=4.0), Place(speeds=(2.0, 0.0, 1.0)), [0.625]),
        (Odometer("right", range=4.0), Place(speeds=(2.0, 0.0, 1.0)), [0.875]),
        (Position("x", range=20.0), Place(middle=(10.0, -5.0)), [0.75]),
        (Position("y", range=20.0), Place(middle=(10.0, -5.0)), [0.375]),
        (Clock(4.0), Place(), [0.375]),
        (Floor("x", at=(0.5, -0.5), ahead=2.0), Place((2.0, 1.0), size=1.0), [1.0, 0.0]),
        (Floor("x", at=(0.5,), ahead=2.0), Place((-0.5, 2.0), size=0.1, angle=pi / 2), [1.0]),
        (Floor("x"), Place((0.9, 0.9)), [0.0]),
        (Floor("x"), Place((0.9, 0.9), is_round=False), [1.0]),
        (Floor("x"), Place(there=False), [0.0]),
        (Bumper(at=(0.0, pi / 2, pi)), Place(boxes=((3.0, 0.0, 2.0),)), [1.0, 0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2, pi)), Place(boxes=((3.1, 0.0, 2.0),)), [0.0, 0.0, 0.0]),
        (Bumper(at=(0.0, pi / 4)), Place(boxes=((1.6, 1.6, 1.0),)), [0.0, 1.0]),
        (Bumper(at=(0.0,), width_=pi / 2 + 0.01), Place(boxes=((1.6, 1.6, 1.0),)), [1.0]),
        (Bumper(at=(0.0, pi / 2)), Place(middle=(49.5, 0.0)), [1.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place(middle=(0.0, -49.5), angle=pi), [0.0, 1.0]),
        (Bumper(at=(0.0, pi / 2)), Place(half=np.inf), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place((0.0, 1.99), turned=0.0), [0.0, 1.0]),
        (Bumper(at=(0.0, pi)), Place((-1.99, 0.0), turned=0.0), [0.0, 1.0]),
        (Bumper(at=(0.0, pi / 2)), Place((0.0, 2.01), turned=0.0), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place((0.0, 2.4), is_round=False, turned=pi / 4), [0.0, 1.0]),
        (Bumper(at=(0.0, pi / 2)), Place((0.0, 2.4), is_round=False, turned=0.0), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 4)), Place((1.4, 1.4), is_round=False, turned=pi / 4), [0.0, 1.0]),
        (Bumper(at=(0.0, pi / 4)), Place((1.45, 1.45), is_round=False, turned=pi / 4), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place((np.nan, np.nan), turned=0.0), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place((2.45, 0.0), turned=0.0, halves=(1.5, 1.0)), [1.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place((0.0, 2.2), turned=0.0, halves=(1.5, 1.0)), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place(boxes=((3.5, 0.0, 2.0),), halves=(1.5, 1.0)), [1.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place(boxes=((3.6, 0.0, 2.0),), halves=(1.5, 1.0)), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place(boxes=((0.0, 3.0, 2.0),), halves=(1.5, 1.0)), [0.0, 1.0]),
        (Bumper(at=(0.0, pi / 2)), Place(boxes=((0.0, 3.2, 2.0),), halves=(1.5, 1.0)), [0.0, 0.0]),
        (Bumper(at=(0.0, pi / 2)), Place(boxes=((0.0, 3.5, 2.0),), halves=(1.5, 1.0), angle=pi / 2), [1.0, 0.0]),
        (Bumper(at=(-pi / 4, pi / 4)), Place(middle=(48.24, 0.0), halves=(1.5, 1.0), angle=pi / 4), [1.0, 0.0]),
        (Bumper(at=(-pi / 4, pi / 4)), Place(middle=(48.23, 0.0), halves=(1.5, 1.0), angle=pi / 4), [0.0, 0.0]),
    ],
)  # fmt: skip
def test_what_it_reads(kind: SensorKind, place: Place, reads: list[float]) -> None:
    assert place.reads(kind) == pytest.approx(reads, abs=1e-6)


PURE = [kind for kind in WORLDLY if not type(kind).__name__.startswith(("Range", "Inertial", "Battery", "Direction"))]
PURE += [Clock(0.3), Clock(TICK), Clock(2.0)]


def robot(world: Graph, chosen: list[Any], drive: tuple[float, float]) -> Graph:
    """A robot that has these sensors and drives in circles in a world."""
    starts = np.cumsum([0, *(prod(kind.shape) for kind in chosen)]).tolist()
    sensors = tuple(Sensor(f"s{i}", kind, starts[i], prod(kind.shape)) for i, kind in enumerate(chosen))
    top = rule("Top", *(always("actuator", i, v) for i, v in enumerate(drive)), reads=tuple(range(starts[-1])))
    task = replace(world.tasks[0], ticks=60, rewards=(Reward("", (("number", 1.0),), None),), ends=(), fails=())
    task = replace(task, varies=tuple(each for each in task.varies if each.noun in ("body", "thing")))
    return replace(mind(top), sensors=sensors, tasks=(task,), body=world.body)


def known(graph: Graph) -> World:
    """What is known of its world before anything runs."""
    task = graph.tasks[0]
    is_solid = task.scene.is_bounded or any(thing.kind.is_solid for thing in task.things)
    names = frozenset(
        thing.name for thing in task.things if not thing.kind.is_obstacle or thing.kind.obstacles(task.scene)
    )
    return World(is_solid=is_solid, can_hold=True, things=names)


@settings(max_examples=cases(60), suppress_health_check=list(HealthCheck))
@given(
    random_world(), st.lists(st.sampled_from(PURE), min_size=1, max_size=8),
    st.tuples(st.floats(0, 1), st.floats(0, 1)), st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_compiled_lanes_read_the_bits_of_plain_python(
    world: Graph, chosen: list[Any], drive: tuple[float, float], seed: int
) -> None:
    graph = robot(world, chosen, drive)
    rollout = Rollout(Policy(graph, {}), "World", "Top")
    jobs = rollout.jobs(np.zeros((1, 0), F), np.array([seed], np.uint64))
    tile = rollout.tile(1)
    rollout.fill(tile, jobs)
    state, tables = tile.state, rollout.tables
    constants = [(each, value) for each in graph.sensors if (value := each.kind.constant(known(graph))) is not None]
    parts = {name: getattr(tables, name) for name in tables.layout()}
    structured = {name for name, part in parts.items() if isinstance(part, np.ndarray) and part.dtype.names}
    rows = {name: part.view(np.recarray) if name in structured else part for name, part in parts.items()}
    working = 1
    while working:
        before = {
            name: getattr(state.world, name).copy() for name in ("body", "heading", "things", "loose", "held", "tick")
        }
        working = rollout.advance(tile, jobs, 1)
        plain = np.zeros_like(state.mind.readings)
        things = before["things"]
        for i in range(len(tables.things)):
            dx, dy = (things[THING_ROWS * i + k] - before["body"][k] for k in (0, 1))
            things[THING_ROWS * i + DISTANCE] = np.sqrt(dx * dx + dy * dy)
        senses = SimpleNamespace(
            **before, readings=plain, nearest=np.zeros((THING_ROWS, 1)), sight=state.sight.sight,
            nearest_of=np.array([-1]), frame=np.zeros((FRAME_ROWS, 1), F),
            boxes=state.world.boxes, nearby=state.sight.nearby, nearby_count=state.sight.nearby_count,
            seed=state.world.seed, active=np.zeros(1, np.uint64), swivel=state.world.swivel,
        )  # fmt: skip
        with np.errstate(all="ignore"):
            for row, kind in zip(rows["sensors"], chosen, strict=True):
                plain_lane(kind.lane)(SimpleNamespace(**rows), senses, 1, 0, row)
        assert np.array_equal(plain[: graph.width, 0], state.mind.readings[: graph.width, 0]), chosen
        for sensor, constant in constants:
            assert (plain[sensor.start : sensor.start + sensor.width, 0] == F(constant)).all(), sensor


def test_every_sensor_that_measures_takes_faults() -> None:
    perfect = {"derivative", "sine", "clock"}
    assert {name for name, cls in kinds("sensor").items() if not issubclass(cls, Physical)} >= perfect
    assert all(issubclass(kinds("sensor")[name], Physical) for name in ("eye", "bumper", "floor", "light", "distance"))
