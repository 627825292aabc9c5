"""Small minds for tests, put together by hand."""

from mindrun.graph.graph import Actuator, Edge, Graph, Memory, Program, Sensor, Skill
from mindrun.kinds.actuators.actuator import Gripper, Wheel
from mindrun.kinds.bodies.body import Disc
from mindrun.kinds.functions.function import Function, Rule
from mindrun.kinds.memory import Cell
from mindrun.kinds.sensors.battery import Battery

WHEELS = (Actuator("left_wheel", Wheel("left", 0.5)), Actuator("right_wheel", Wheel("right", 0.5)))
CLAW = Actuator("claw", Gripper(0.25))


def mind(
    *skills: Skill, readings: int = 1, actuators: tuple[Actuator, ...] = WHEELS, cells: tuple[Cell, ...] = ()
) -> Graph:
    """A mind over sensors r0, r1, … whose first skill is its master."""
    sensors = tuple(Sensor(f"r{i}", Battery(), i, 1) for i in range(readings))
    memories = tuple(Memory(f"m{i}", cell, readings + i) for i, cell in enumerate(cells))
    return Graph(1 / 60, Disc(), skills[0].name, sensors, memories, actuators, skills, (), ())


def rule(name: str, *edges: Edge, reads: tuple[int, ...] = ()) -> Skill:
    """A rule."""
    return Skill(name, Rule(), reads, edges)


def skill(name: str, function: Function, reads: tuple[int, ...], *targets: tuple[str, int]) -> Skill:
    """A skill whose edges are all outputs of its function."""
    return Skill(name, function, reads, tuple(Edge(to, target, i) for i, (to, target) in enumerate(targets)))


def always(to: str, target: int, value: float) -> Edge:
    """An edge with a constant `at`."""
    return Edge(to, target, None, (("number", value),))


def program(*terms: tuple[str, float | int]) -> Program:
    """A postfix program."""
    return terms
