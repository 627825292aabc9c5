"""Small minds for the simulator's tests, compiled from source text."""

from mindrun.graph.graph import Graph

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

DRIFTER = """
tick 1/60 s
master Drift
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor slow is sine period 7.3 s
sensor quick is sine period 1.9 s
sensor odd is sine period 0.77 s
sensor object_bearing is bearing of object
skill Drift is rule
  reads slow
  reads quick
  reads odd
  reads object_bearing
  drives left_wheel at 0.25 + slow * 0.7 + (object_bearing - 0.5) * quick
  drives right_wheel at 0.95 - slow * 0.6 + quick * odd / 3 - (object_bearing - 0.5) * 0.8
  drives claw at 0.2 + slow
"""


def compile_text(text: str) -> Graph:
    """The graph of a program that has to be right."""
    compiled = compile_source(Source("test.mind", text))
    assert compiled.graph is not None, [d.message for d in compiled.diagnostics]
    return compiled.graph


def drifter(scene: str, ticks: int, rocks: str = "") -> Graph:
    """A robot that wanders about among `rocks`, drawn to an object, and closes its claw now and then."""
    place = "arena size 40" if scene == "arena" else "plain"
    lines = [f"task Drift in {place}", "  contains object is item size 1"]
    lines += [f"  contains rock is obstacle {rocks}"] if rocks else []
    lines += [f"  lasts {ticks} ticks", "  rewards progress toward object per tick", "  rewards 1 on collision"]
    return compile_text(DRIFTER + "\n".join(lines) + "\n")
