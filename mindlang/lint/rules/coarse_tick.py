"""A tick in which the robot moves as far as it is large.

Its sensors look, and its rewards are paid, once a tick. The simulation lets nothing pass what is solid: where a tick
takes a robot far, it is computed in several shorter steps, at a price in time.
"""

from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.top_speed import farthest_step

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


def check(study: Study) -> Found:
    graph, body = study.graph, study.mind.body
    far, task = farthest_step(graph)
    size = 2 * min(graph.body.front, graph.body.side)
    if far > MOST_SIZES * size:
        moves = f"{body.name} moves {far:.3g} units in a tick of {task}"
        share = MOST_SIZES * size / far
        hint = f"Give it at most {share:.2g} of its thrust, a shorter tick, more density or more linear_damping."
        yield Finding(body.span, f"At full thrust {moves}, {far / size:.2g} times its size.", hint)
