"""Random worlds of any size, in which robots of any speed drive between thin walls, corners and what gives way."""

from collections.abc import Sequence
from dataclasses import replace
from math import pi
from random import Random

from mindrun.graph.graph import Actuator, Graph, Thing
from mindrun.kinds.actuators.actuator import Motor, Steering, Thruster, Wheel
from mindrun.kinds.bodies.body import BodyKind, Box, Car, Disc, Holonomic
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.things.loose import Ball, LooseBox
from mindrun.kinds.things.map import Map
from mindrun.kinds.things.thing import Item
from mindrun.kinds.things.walker import Walker
from mindrun.kinds.things.wall import Wall
from mindrun.numbers.quantity import Span

from tests.sim.minds import compile_text

MIND = """
tick 1/60 s
master Go
body Robot is disc
actuator l is wheel side left neutral 0.5
actuator r is wheel side right neutral 0.5
actuator claw is gripper neutral 0 reach {reach}
sensor slow is sine period {slow} s
sensor quick is sine period {quick} s
sensor way is bearing of coin
skill Go is rule
  reads slow
  reads quick
  reads way
  drives l at {left}
  drives r at {right}
  drives claw at 0.3 + slow
task World in arena size 50
  contains coin is item
  lasts {ticks} ticks
  rewards 1 per tick
  counts collision
"""
COMMANDS = [  # of both drives
    ("1", "1"),
    ("1", "0.5 + slow / 2"),
    ("0.5 + slow", "1.5 - quick"),
    ("way + 0.3", "1.3 - way"),
    ("2 * way + slow - 0.5", "2.5 - 2 * way - quick"),
]
TICKS = [1 / 100, 1 / 60, 1 / 30, 1 / 20, 1 / 10, 1 / 5]


def swift_world(random: Random, ticks: int) -> Graph:
    """A graph with one task, World: sizes from 0.05 to 10, thrusts over five decades, ticks from 1/100 to 1/5 s."""
    size = among(random, 0.05, 10)
    left, right = random.choice(COMMANDS)
    slow, quick, reach = among(random, 0.1, 5), among(random, 0.1, 5), round(size * among(random, 0.3, 4), 3)
    graph = compile_text(MIND.format(reach=reach, slow=slow, quick=quick, left=left, right=right, ticks=ticks))
    body, drives = _robot(random, size)
    sides = size * among(random, 5, 40), size * among(random, 5, 40)
    actuators = (Actuator("l", drives[0]), Actuator("r", drives[1]), graph.actuators[2])
    task = replace(graph.tasks[0], scene=Arena(sides), things=tuple(_things(random, size, sides)))
    return replace(graph, tick=random.choice(TICKS), body=body, actuators=actuators, tasks=(task,))


def among(random: Random, low: float, high: float) -> float:
    """A number between, of any order of magnitude."""
    return float(f"{low * (high / low) ** random.random():.4g}")


def _robot(random: Random, size: float) -> tuple[BodyKind, Sequence[object]]:
    """Any body, and what drives it."""
    lost, slowed = random.choice([0.0, 1.0, 5.0]), random.choice([1.0, 20.0])
    own = {"density": among(random, 0.05, 20), "friction": random.choice([0.0, 0.2, 1.5])}
    own |= {"linear_damping": lost, "angular_damping": slowed}
    thrust = size * size * among(random, 1, 1e5)
    wheels = Wheel("left", 0.5, thrust=thrust), Wheel("right", 0.5, thrust=thrust)
    thrusters = Thruster(0.5, (0.0, 0.0), 0.3, thrust=thrust), Thruster(0.5, (0.0, 0.1), pi / 2, thrust=thrust)
    rectangle = size, round(size * among(random, 0.1, 1), 4)
    return random.choice(
        [
            (Disc(size, **own), wheels),
            (Disc(size, **own), wheels),
            (Box(rectangle, **own), wheels),
            (Car(rectangle, 0.6, **own), (Motor(0.5, thrust=thrust), Steering(0.5, 0.7))),
            (Holonomic(size, **own), thrusters),
        ]
    )


def _things(random: Random, size: float, sides: tuple[float, float]) -> list[Thing]:
    """Walls, a map, what gives way, what can be held, what walks."""
    found, far = [], max(sides)
    for i in range(random.randrange(4)):
        ends = tuple(tuple(random.uniform(-0.5, 0.5) * side for side in sides) for _ in range(2))
        ends = random.choice([(ends[0], (ends[1][0], ends[0][1])), (ends[0], (ends[0][0], ends[1][1]))])
        found.append(Thing(f"wall{i}", Wall(ends, size * among(random, 0.01, 2))))
    if random.random() < 0.5:
        columns = random.randrange(3, 9)
        rows = tuple("".join(random.choice("#...") for _ in range(columns)) for _ in range(columns))
        rows = random.choice([rows, ("#.#.#.#", ".#.#.#.", "......."), ("#..", ".#.", "..#")])
        found.append(Thing("maze", Map(rows, min(sides) / max(len(rows), len(rows[0])))))
    for i in range(random.randrange(4)):
        kind, span = random.choice([LooseBox, Ball, Ball]), size * among(random, 0.05, 2)
        own = {"friction": random.choice([0.0, 0.5, 1.0]), "damping": random.choice([0.0, 3.0])}
        own["density"] = among(random, 0.01, 100)
        if random.random() < 0.3:
            speed, thrust = size * among(random, 0.1, 1000), size * size * among(random, 0.1, 1e5)
            own |= {random.choice(["seeks", "flees"]): "robot", "speed": speed, "thrust": thrust}
        found.append(Thing(f"loose{i}", kind(size=Span(span, span), away=Span(0.0, far), **own)))
    span = size * among(random, 0.05, 1.5)
    found.append(Thing("coin", Item(size=Span(span, span), away=Span(0.0, 3 * size), count=3)))
    if random.random() < 0.5:
        span, speed = size * among(random, 0.1, 2), size * among(random, 0.1, 1000)
        found.append(Thing("cat", Walker(size=Span(span, span), away=Span(0.0, far), speed=speed, turning=1.5)))
    return found
