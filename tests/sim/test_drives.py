"""Loose things that drive themselves: bit for bit what plain pymunk makes of the forces, and what these are for."""

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.draws import first
from tests.sim.following import follow
from tests.sim.minds import compile_text

ROBOT = """
tick 1/TICKS s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 120
actuator right_wheel is wheel side right neutral 0.5 thrust 120
"""
MIND = f"""{ROBOT}
sensor slow is sine period 7.3 s
sensor quick is sine period 3.1 s
sensor foe_bearing is bearing of foe
skill Go is rule
  reads slow
  reads quick
  reads foe_bearing
  drives left_wheel at 1.3 * quick + foe_bearing - 0.4
  drives right_wheel at 1.3 * slow - foe_bearing + 0.6
task World in arena size 24
  contains foe is box size 3 density 1 seeks robot speed 4 thrust 150 count 2 OUTCOME
  contains rock is obstacle grid 12 size 1 to 2 jitter 3
  contains fox is ball size 2 flees robot range 9 speed 6 OUTCOME
  contains dog is ball size 1 seeks fox speed 300 thrust 2000 damping 0
  contains crate is box size 2
  contains bee is ball size 1 density 2 seeks bee range 8 thrust 3 count 2
  contains home is zone size 7
  contains tug is box size 1 seeks home speed 20
  varies speed of foe 2 to 5
  varies thrust of fox 20 to 90
  varies density of dog 0.2 to 3
  lasts LASTS ticks
  rewards progress toward foe per tick
  counts collision
  counts reach of foe
  counts delivery of fox
"""


@pytest.mark.parametrize("seed", first(4, range(16)))
def test_forces_equal_plain_pymunk(seed: int) -> None:
    """Between walls, obstacles, the robot and each other, which all of them push."""
    outcome = ("", "delivered stays", "reached vanishes", "reached moves")[seed % 4]
    graph = compile_text(
        MIND.replace("OUTCOME", outcome)
        .replace("TICKS", ("60", "20", "10")[seed % 3])
        .replace("LASTS", "400" if seed < 4 else "1200")
    )
    rollout = Rollout(Policy(graph, {}), "World", "Go")
    happened = follow(rollout, Engine(Policy(graph, {})), seed)
    assert happened["Reach"] > 0


def places(contents: str, ticks: int = 200, seed: int = 1, commands: str = "0.5") -> np.ndarray:
    """Where the things of a world, and last the robot, are after each of some ticks [ticks, things + 1, 2]."""
    lines = [f"  drives {side}_wheel at {commands}" for side in ("left", "right")]
    task = f"task World in arena size 60\n  starts at 0 0 facing 0 deg\n{contents}\n  lasts {ticks} ticks"
    text = "\n".join([ROBOT.replace("TICKS", "20"), "skill Go is rule", *lines, task])
    graph = compile_text(text)
    run = trace(Rollout(Policy(graph, {}), "World", "Go"), seed)
    return np.array([[*moment.things[:, :2], moment.body[:2]] for moment in run.moments])


def test_it_goes_straight_at_its_speed_and_no_farther_than_there() -> None:
    """Ten ticks of a fifth of a unit for two units; the first of them is that in which the force acts."""
    foe = "foe is box at 10 5 seeks den speed 4 thrust 9999 delivered stays"
    track = places(f"  contains den is zone size 4 at 13 9\n  contains {foe}")
    gone = np.linalg.norm(track[:, 1] - (10, 5), axis=1)
    assert gone[:26] == pytest.approx(np.arange(26) / 5)
    assert gone[26:] == pytest.approx(5)
    assert (track[:, 1] - (10, 5)) @ (4, -3) == pytest.approx(0)


def test_its_thrust_is_what_it_gains_speed_by_and_what_it_is_slowed_to() -> None:
    """Of mass 2, with a thrust of 3: 0.075 units a second more in each tick, and 3 / 2 in the end, damped by 1."""
    track = places("  contains foe is ball size 2 density 0.63662 at -25 9 damping 1 flees robot thrust 3 speed 9")
    steps = np.linalg.norm(np.diff(track[:, 0], axis=0), axis=1)[:100] * 20
    share = 1 / 1.05
    assert steps[:20] == pytest.approx([0.075 * sum(share**n for n in range(1, k + 2)) for k in range(20)], rel=1e-4)


def test_out_of_range_it_rests_and_who_is_pushed_by_it_gives_way() -> None:
    rest = places("  contains foe is box at 20 0 seeks robot range 19 speed 4")
    assert (rest[:, 0] == (20, 0)).all()
    pushed = places("  contains foe is box size 3 at 20 0 seeks robot speed 4", 300)
    assert pushed[-1, 1, 0] < -5, "a robot that stands still"
    assert pushed[-1, 0, 0] == pytest.approx(pushed[-1, 1, 0] + 2.5, abs=0.2)


@pytest.mark.parametrize(("thrust", "wins"), [(200, True), (280, False)])
def test_the_stronger_pushes_the_weaker_one(thrust: int, wins: bool) -> None:
    """A robot of two wheels of 120 each drives ahead."""
    met = places(f"  contains foe is box size 3 at 20 0 seeks robot speed 9 thrust {thrust}", 300, commands="1")
    assert (met[-1, 1, 0] > met[150, 1, 0] + 1) == wins
    assert (met[-1, 1, 0] < met[150, 1, 0] - 1) != wins
