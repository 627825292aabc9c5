"""The top speed that `coarse-tick` tells is the one that a robot reaches, and that `unsaid-thrust` proposes."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.lanes.solid import MOST_STRIDES, STRIDE_SHARE
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from mindlang.compiler.source import spliced
from mindlang.lint.lint import lint
from mindlang.lint.top_speed import step_of
from tests.calling import Call
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


SILENT = "actuator one is {0} neutral 0.5\nactuator other is {1} neutral 0.5"


@pytest.mark.parametrize(
    ("body", "drives", "other"),
    [
        ("disc size 0.2", ("wheel side left", "wheel side right"), 1),
        ("disc size 60 density 0.1", ("wheel side left", "wheel side right"), 1),
        ("box size 0.5 0.1 linear_damping 2", ("thruster at 0 0", "thruster facing 0 deg"), 1),
        ("car size 30 20", ("motor", "steering"), 0.5),
        ("holonomic size 0.02", ("thruster facing 80 deg", "thruster facing 130 deg at 0.01 0"), 1),
    ],
)
def test_the_thrust_that_is_proposed_takes_a_body_twice_its_length_a_second(
    body: str, drives: tuple[str, str], other: float, tmp_path: Path
) -> None:
    text = MIND.format(tick="1/50", body=body, actuators=SILENT.format(*drives), other=other, ticks=600, varies="")
    (path := tmp_path / "silent.mind").write_text(text.strip() + "\n")
    [found] = lint(load(path), ["unsaid-thrust"])
    assert found.fix
    path.write_text(spliced(found.fix.splices[0].source, found.fix.splices))
    graph = load(path).graph
    assert graph
    assert lint(load(path), ["unsaid-thrust"]) == []
    places = np.array([moment.body[:2] for moment in trace(Rollout(Policy(graph, {}), "World", "Go"), 1).moments])
    speeds = np.hypot(*np.diff(places, axis=0).T) * 50
    assert speeds.max() == pytest.approx(2 * 2 * graph.body.front, rel=0.1)


def test_check_says_whose_tick_is_not_simulated_whole(mindc: Call, tmp_path: Path) -> None:
    assert mindc("check", written(tmp_path, 47)).err == "nothing wrong\n"
    found = mindc("check", fast := written(tmp_path, 47.2))
    assert found.code == 0
    assert MOST_STRIDES * STRIDE_SHARE * 0.1 == 5.0  # half of its size
    assert found.err == (
        f"note: {fast}: its robot moves 5.01 units in a tick of World at full thrust; beside a wall 5 of them are "
        f"simulated; mindc lint {fast} says what helps\nnothing wrong\n"
    )


def written(folder: Path, thrust: float) -> Path:
    """A small robot of that thrust, in a file."""
    text = MIND.format(
        tick="1/60", body="disc size 0.2", actuators=WHEELS.format(thrust), other=1, ticks=400, varies=""
    )
    (folder / "fast.mind").write_text(text.lstrip())
    return folder / "fast.mind"
