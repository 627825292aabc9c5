"""A tick in which the robot moves as far as it is large.

Its sensors look, and its rewards are paid, once a tick. The simulation lets nothing pass what is solid: where a tick
takes a robot far, it is computed in several shorter steps, at a price in time. What nothing is said of, such as a
thrust of 80, fits a robot of size 2: one that is written in metres wants a thrust of its own.
"""

from math import cos, inf, pi, sin

from mindrun.graph.graph import Graph, Task

from mindlang.lint.study import Finding, Found, Study

WHEELS = """
tick {}
body Robot is disc size {}
actuator left_wheel is wheel side left neutral 0.5 thrust {}
actuator right_wheel is wheel side right neutral 0.5 thrust {}
task Room in arena size 40
  lasts 9 s
  rewards 1 per tick
"""
GOOD = (WHEELS.format("1/60 s", 2, 80, 80), WHEELS.format("1/60 s", 0.2, 0.5, 0.5))
BAD = (
    WHEELS.format("1/60 s", 0.2, 80, 80),
    WHEELS.format("1/10 s", 2, 600, 600),
    WHEELS.format("1/60 s", 2, 80, 80) + "  varies density of Robot 0.01 to 2\n",
)
MOST_SIZES = 0.75  # of its lesser side
SIMULATED_SIZES = 25.0  # of its lesser side, in one tick: mindrun.sim.strides, whose import is slow
TRIED_DIRECTIONS = 180  # that are tried


def check(study: Study) -> Found:
    """A body that full thrust moves further in a tick of any task than it may."""
    graph, body = study.graph, study.mind.body
    far, task = farthest_step(graph)
    size = 2 * min(graph.body.front, graph.body.side)
    if far > MOST_SIZES * size:
        moves = f"{body.name} moves {far:.3g} units in a tick of {task}"
        share = MOST_SIZES * size / far
        hint = f"Give it at most {share:.2g} of its thrust, a shorter tick, more density or more linear_damping."
        yield Finding(body.span, f"At full thrust {moves}, {far / size:.2g} times its size.", hint)


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
