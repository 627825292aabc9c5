"""The top speed that `coarse-tick` tells is the one that a robot reaches."""

from dataclasses import replace

import numpy as np
import pytest
from mindrun.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.rules.coarse_tick import step_of
from tests.sim.minds import compile_text

MIND = """
tick {tick} s
master Go
body Robot is {body}
{actuators}
skill Go is rule
  drives one at 1
  drives other at {other}
task World in plain
  starts at 0 0 facing 0 deg
  lasts {ticks} ticks
  rewards 1 per tick
{varies}
"""
WHEELS = (
    "actuator one is wheel side left neutral 0.5 thrust {0}\nactuator other is wheel side right neutral 0.5 thrust {0}"
)
ASKEW = (
    "actuator one is thruster neutral 0.5 thrust 30\nactuator other is thruster facing 120 deg neutral 0.5 thrust -50"
)
CAR = "actuator one is motor neutral 0.5 thrust 300\nactuator other is steering neutral 0.5 range 30 deg"


@pytest.mark.parametrize(
    ("body", "actuators", "other"),
    [
        ("disc size 0.2", WHEELS.format(80), 1),
        ("box size 3 1 density 5", WHEELS.format(-7), 1),
        ("car size 3 2", CAR, 0.5),
        ("holonomic size 1", ASKEW, 1),
        ("disc size 2 linear_damping 0", WHEELS.format(80), 1),
    ],
)
@pytest.mark.parametrize("tick", ["1/60", "1/5"])
@pytest.mark.parametrize(
    "varies", ["", "  varies density of Robot 0.5 to 0.5", "  varies linear_damping of Robot 1 to 1"]
)
def test_it_is_what_a_robot_reaches(body: str, actuators: str, other: float, tick: str, varies: str) -> None:
    text = MIND.format(tick=tick, body=body, actuators=actuators, other=other, ticks=400, varies=varies)
    graph = compile_text(text.replace("\n\n", "\n"))
    places = np.array([moment.body[:2] for moment in trace(Rollout(Policy(graph, {}), "World", "Go"), 1).moments])
    moved = np.hypot(*(places[-1] - places[-2]))
    assert moved == pytest.approx(step_of(graph, graph.tasks[0]), rel=0.01)
    twice = replace(graph, tick=graph.tick / 2)
    assert step_of(twice, graph.tasks[0]) < step_of(graph, graph.tasks[0])
