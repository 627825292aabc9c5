"""How far a robot goes in a tick at its top speed, in each of its tasks."""

from math import cos, inf, pi, sin

from mindrun.graph.graph import Graph, Task

SIMULATED_SIZES = 25.0  # of its lesser side, in one tick: mindrun.sim.lanes.solid, whose import is slow
TRIED_DIRECTIONS = 180  # that are tried


def simulated_step(graph: Graph) -> float:
    """How far a tick takes a body beside something solid at most; what time is left then is lost."""
    return SIMULATED_SIZES * 2 * min(graph.body.front, graph.body.side)


def farthest_step(graph: Graph) -> tuple[float, str]:
    """How far a body goes in a tick at its top speed, in world units, and in which task; 0 without a world of ours."""
    tasks = [task for task in graph.tasks if not task.scene.environment]
    return max(((step_of(graph, task), task.name) for task in tasks), default=(0.0, ""))


def step_of(graph: Graph, task: Task) -> float:
    """How far a body goes in a tick of a task at its top speed, in world units."""
    body, pushed = graph.body, []
    for actuator in graph.actuators:
        row = actuator.kind.row(body)
        if "thrust" in row:
            thrust = max(abs(value) for value in _values(task, "actuator", actuator.name, "thrust", row["thrust"]))
            pushed.append((thrust * row["ahead"], thrust * row["aside"]))
    angles = (pi * i / TRIED_DIRECTIONS for i in range(TRIED_DIRECTIONS))
    force = max(sum(abs(ahead * cos(at) + aside * sin(at)) for ahead, aside in pushed) for at in angles)
    density = min(_values(task, "body", "", "density", body.density))
    damping = min(_values(task, "body", "", "linear_damping", body.linear_damping))
    gained = force / (density * body.area[0] * body.area[1]) * graph.tick  # of speed in a tick
    return gained * min(1 / damping if damping else inf, task.ticks * graph.tick)


def _values(task: Task, noun: str, of: str, argument: str, value: float) -> tuple[float, ...]:
    """The least and the greatest value of an argument where it varies, or its only one."""
    found = (each for each in task.varies if (each.noun, each.of, each.argument) == (noun, of, argument))
    return next(((each.low, each.high) for each in found), (value,))
