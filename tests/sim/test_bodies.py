"""Bodies of every kind against plain pymunk, bit for bit, and what they do that a disc on wheels does not."""

from collections.abc import Iterator
from math import atan, atan2, cos, hypot, pi, sin, tan

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.draws import first
from tests.sim.following import follow
from tests.sim.minds import compile_text
from tests.sim.plain_world import PlainWorld

SENSES = """
tick 1/60 s
master Drift
sensor slow is sine period 7.3 s
sensor quick is sine period 1.9 s
sensor odd is sine period 0.77 s
sensor eyes is range_finder at -40 0 40 170 deg range 9
"""
SKILL = """
skill Drift is rule
  reads slow
  reads quick
  reads odd
  reads eyes
"""
CAR = """
body Robot is car size 3 2
actuator wheels is steering neutral 0.5 range 35 deg
actuator engine is motor neutral 0.5 thrust 300
actuator claw is gripper neutral 0 reach 8
"""
CAR_DRIVES = """
  drives wheels at slow + (quick - 0.5) * 0.4
  drives engine at 0.2 + 0.9 * quick + 0.3 * odd
  drives claw at 0.2 + slow
"""
HOLONOMIC = """
body Robot is holonomic size 2
actuator one is thruster at 1 0 facing 90 deg neutral 0.5 thrust 300
actuator two is thruster at -0.5 0.8 facing 210 deg neutral 0.5 thrust 340
actuator three is thruster at -0.5 -0.8 facing 330 deg neutral 0.5 thrust 400
actuator claw is gripper neutral 0 reach 8
"""
HOLONOMIC_DRIVES = """
  drives one at 0.1 + slow * 0.8 + odd * 0.2
  drives two at quick
  drives three at 0.3 + odd * slow
  drives claw at 0.2 + slow
"""
BOX = """
body Robot is box size 2 3 friction 0.7 density 1
actuator left_wheel is wheel side left neutral 0.5 thrust 120
actuator right_wheel is wheel side right neutral 0.5 thrust 120
actuator claw is gripper neutral 0 reach 8
"""
BOX_DRIVES = """
  drives left_wheel at 0.25 + slow * 0.7
  drives right_wheel at 0.95 - slow * 0.6 + quick * odd / 3
  drives claw at 0.2 + slow
"""
ROUGH = {" thrust ": " noise 10% slip 30% delay 2 ticks thrust ", "neutral 0 ": "neutral 0 noise 20% "}
ROBOTS = {"car": (CAR, CAR_DRIVES), "holonomic": (HOLONOMIC, HOLONOMIC_DRIVES), "box": (BOX, BOX_DRIVES)}


def task(ticks: int, place: str = "arena size 40", rocks: str = "contains rock is obstacle grid 10 size 2 to 4") -> str:
    return f"""
task Drift in {place}
  contains object is item size 1 to 2
  {rocks}
  lasts {ticks} ticks
  rewards 1 on collision
  rewards p per tick for each p in eyes
"""


def robot(name: str, ticks: int, **options: str) -> Graph:
    parts, drives = ROBOTS[name]
    return compile_text(SENSES + parts + SKILL + drives.strip("\n") + "\n" + task(ticks, **options))


def moments(graph: Graph, seed: int = 1) -> Iterator[Moment]:
    return trace(Rollout(Policy(graph, {}), "Drift", "Drift", interrupt=False), seed).moments


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("seed", first(2, range(6)))
def test_every_body_moves_and_touches_as_in_plain_pymunk(name: str, seed: int) -> None:
    """Into obstacles, walls and corners, with and without an item in the claw."""
    graph = robot(name, 5_000)
    run = trace(Rollout(Policy(graph, {}), "Drift", "Drift", interrupt=False), seed)
    plain = PlainWorld(graph, graph.tasks[0], run, battery=False)
    angle, touched = run.begin[2], 0
    for moment in run.moments:
        plain.places = moment.things.copy()
        state = plain.body.step(moment.acting, moment.grip, cosine(angle), sine(angle), moment.held, plain.places)
        assert np.array_equal(state, moment.body), f"tick {moment.tick}"
        angle = moment.body[2]
        touched += moment.touching
    assert moment.tick == 5_000
    assert touched > 20


@pytest.mark.parametrize("name", ROBOTS)
def test_every_tick_is_what_plain_python_says(name: str) -> None:
    parts, drives = ROBOTS[name]
    for old, new in ROUGH.items():
        parts = parts.replace(old, new)
    graph = compile_text(SENSES + parts + SKILL + drives.strip("\n") + "\n" + task(600))
    happened = follow(Rollout(Policy(graph, {}), "Drift", "Drift"), Engine(Policy(graph, {})), 5)
    assert happened["Collision"] > 0


def steady(wheels: str, engine: str = "0.8") -> list[Moment]:
    """A car alone in the plain, its commands always the same."""
    drives = f"  drives wheels at {wheels}\n  drives engine at {engine}\n"
    return list(moments(compile_text(SENSES + CAR + SKILL + drives + task(600, "plain", ""))))


@pytest.mark.parametrize(("command", "way"), [("0.2", 1), ("0.8", -1)])
def test_a_car_drives_the_circle_of_its_steering(command: str, way: int) -> None:
    """To the left below 0.5; the radius of the middle is √((axles / tan δ)² + (axles / 2)²)."""
    *_, before, last = steady(command)
    x, y, turn = last.body[:3] - before.body[:3]
    turned, axles = 0.6 * 35 * pi / 180, 0.6 * 3
    assert turn * way > 0.001
    assert hypot(x, y) / abs(turn) == pytest.approx(hypot(axles / tan(turned), axles / 2))
    course = atan2(y, x)
    slip = (course - before.body[2] + pi) % (2 * pi) - pi
    assert slip == pytest.approx(way * atan(tan(turned) / 2))


def test_a_car_that_steers_straight_ahead_stays_on_its_line() -> None:
    first, *_, last = steady("0.5")
    x, y = last.body[:2] - first.body[:2]
    angle = first.body[2]
    assert abs(y * cos(angle) - x * sin(angle)) < 1e-9
    assert x * cos(angle) + y * sin(angle) > 10
    assert last.body[2] == angle


def test_a_car_stands_where_its_motor_stops() -> None:
    first, *_, last = steady("0.1", "0.5")
    assert np.array_equal(first.body, last.body)


def test_thrusters_push_to_any_side_without_a_turn() -> None:
    text = HOLONOMIC.replace("at 1 0 facing 90 deg", "facing 90 deg")
    graph = compile_text(SENSES + text + SKILL + "  drives one at 1\n" + task(300, "plain", ""))
    first, *_, last = moments(graph)
    x, y = last.body[:2] - first.body[:2]
    angle = first.body[2]
    assert last.body[2] == angle
    assert y * cos(angle) - x * sin(angle) > 10
    assert abs(x * cos(angle) + y * sin(angle)) < 1e-9


@pytest.mark.parametrize(
    ("said", "least", "most"), [("slip 40%", 0.7, 0.9), ("noise 20%", 0.9, 1.1), ("noise 20% slip 40%", 0.6, 0.95)]
)
def test_what_slips_goes_less_far_and_what_is_noisy_as_far(said: str, least: float, most: float) -> None:
    def distance(words: str) -> float:
        text = CAR.replace("thrust 300", f"thrust 300 {words}")
        drives = "  drives engine at 0.7\n"
        first, *_, last = moments(compile_text(SENSES + text + SKILL + drives + task(600, "plain", "")))
        return hypot(*(last.body[:2] - first.body[:2]))

    assert least < distance(said) / distance("") < most


def test_a_ray_begins_where_it_leaves_a_rectangle() -> None:
    """Before a wall, a long robot reads less ahead than a short one at the same place does."""
    graph = robot("car", 1, place="arena size 12", rocks="")
    run = trace(Rollout(Policy(graph, {}), "Drift", "Drift"), 3)
    x, y, angle = run.begin
    (moment,) = run.moments
    eyes = moment.readings[3:7]
    corner = 1 / sin(40 * pi / 180)
    for at, reading, rim in zip((-40, 0, 40, 170), eyes, (corner, 1.5, corner, 1.5 / cos(pi / 18)), strict=True):
        c, s = cos(angle + at * pi / 180), sin(angle + at * pi / 180)
        far = min(((6 if c > 0 else -6) - x) / c, ((6 if s > 0 else -6) - y) / s)
        assert reading == pytest.approx(min(1, max(0, (far - rim) / 9)), abs=1e-5)
