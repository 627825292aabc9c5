"""Boxes and balls that are pushed: bit for bit what plain pymunk makes of them, whatever Chipmunk is not asked."""

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout

from tests.draws import first
from tests.sim.following import follow
from tests.sim.minds import compile_text

MIND = """
tick 1/60 s
master Push
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 240
actuator right_wheel is wheel side right neutral 0.5 thrust 240
actuator claw is gripper neutral 0
sensor slow is sine period 7.3 s
sensor quick is sine period 3.1 s
sensor odd is sine period 2.77 s
sensor crate_bearing is bearing of crate
sensor ball_bearing is bearing of ball
sensor crate_near is contact of crate
sensor eyes is range_finder at 0 35 -35 90 180 -90 deg range 15
sensor box_ahead is eye of crate at -20 0 20 deg range 15
sensor item_ahead is eye of object at -10 10 deg range 15
sensor touch is bumper at 0 45 -45 90 -90 180 deg width 50 deg
skill Push is rule
  reads slow
  reads quick
  reads odd
  reads crate_bearing
  reads ball_bearing
  reads eyes
  reads box_ahead
  reads item_ahead
  reads touch
  drives left_wheel at 1.8 - 2 * odd + 0.9 * (quick - 0.5) + 2 * (crate_bearing - 0.5) * slow + (ball_bearing - 0.5)
  drives right_wheel at 1.8 - 2 * odd - 0.9 * (quick - 0.5) - 2 * (crate_bearing - 0.5) * slow - (ball_bearing - 0.5)
  drives claw at 0.2 + slow
task World in arena size 24
  contains crate is box size 3 OUTCOME
  contains rock is obstacle grid 12 size 1 to 2 jitter 3
  contains ball is ball size 2 OUTCOME
  contains chest is box size 2 density 0.1 friction 0.1 damping 0.5
  contains object is item size 1
  contains marble is ball size 1 density 2 damping 0 count 2
  contains trunk is box size 4 to 3 by 0.25 density 1 OUTCOME
  contains home is zone size 7
  lasts TICKS ticks
  rewards progress toward crate per tick
  counts collision
  counts reach of crate
  counts delivery of crate
  counts delivery of ball
  counts delivery of trunk
"""


def world(ticks: int, outcome: str = "") -> Rollout:
    graph = compile_text(MIND.replace("TICKS", str(ticks)).replace("OUTCOME", outcome))
    return Rollout(Policy(graph, {}), "World", "Push")


@pytest.mark.parametrize("seed", first(3, range(12)))
def test_pushes_equal_plain_pymunk(seed: int) -> None:
    """A robot that drives about between walls, obstacles and loose things, which it pushes against all of them."""
    rollout = world(500 if seed < 3 else 1_500, ("", "delivered stays", "delivered vanishes")[seed % 3])
    happened = follow(rollout, Engine(Policy(rollout.graph, {})), seed)
    assert happened["Collision"] > 0


@pytest.mark.parametrize(("outcome", "seed"), [("moves", 0), ("vanishes", 1)])
def test_what_has_settled_and_is_then_elsewhere_without_a_contact_is_nowhere_else(outcome: str, seed: int) -> None:
    """Reached before it is touched: at the next wall Chipmunk is told where it is, or that it is not there."""
    text = """
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 240
actuator right_wheel is wheel side right neutral 0.5 thrust 240
actuator claw is gripper neutral 0 reach 2
sensor slow is sine period 7.3 s
sensor odd is sine period 2.77 s
sensor crate_bearing is bearing of crate
skill Go is rule
  reads slow
  reads odd
  reads crate_bearing
  drives left_wheel at 1.6 - 2 * odd + 6 * (crate_bearing - 0.5) * slow
  drives right_wheel at 1.6 - 2 * odd - 6 * (crate_bearing - 0.5) * slow
task World in arena size 16
  contains crate is box size 0.5 count 6 reached OUTCOME
  lasts 2000 ticks
  rewards progress toward crate per tick
  counts reach of crate
  counts collision
"""
    rollout = Rollout(Policy(compile_text(text.replace("OUTCOME", outcome)), {}), "World", "Go")
    happened = follow(rollout, Engine(Policy(rollout.graph, {})), seed)
    assert happened["Reach"] > 2
    assert happened["Collision"] > 2


def test_what_is_let_go_and_taken_again_is_pushed_as_plain_pymunk_says() -> None:
    """In a few ticks, at walls: of what is let go Chipmunk forgets the impulses only if it still touches."""
    text = """
tick 1/60 s
master Go
body Robot is disc size 2
actuator l is wheel side left neutral 0.5 thrust 160
actuator r is wheel side right neutral 0.5 thrust 160
actuator claw is gripper neutral 0 reach 3
sensor a is sine period 0.11 s
sensor b is sine period 7.3 s
sensor c is sine period 0.05 s
sensor way is bearing of coin
skill Go is rule
  reads a
  reads b
  reads c
  reads way
  drives l at 1.3 * b + way - 0.4
  drives r at 1.3 * b + 0.6 - way
  drives claw at 20 * a - 20 * c + 0.5
task World in arena size 14
  contains coin is item size 1 count 4
  contains crate is box size 1.5 count 2
  contains ball is ball size 1 count 2
  contains rock is obstacle size 2 count 3
  contains home is zone size 4
  lasts 1000 ticks
  rewards 1 per tick
  counts delivery of coin
  counts collision
"""
    rollout = Rollout(Policy(compile_text(text), {}), "World", "Go")
    happened = follow(rollout, Engine(Policy(rollout.graph, {})), 59)
    assert happened["Collision"] > 2


def test_the_claw_takes_what_nothing_solid_keeps_from_it_as_plain_geometry_says() -> None:
    """Items wider than the gaps between small rocks."""
    text = """
tick 1/60 s
master Go
body Robot is disc size 1
actuator l is wheel side left neutral 0.5 thrust 80
actuator r is wheel side right neutral 0.5 thrust 80
actuator claw is gripper neutral 0 reach 2
sensor a is sine period 0.5 s
sensor b is sine period 7.3 s
sensor way is bearing of coin
skill Go is rule
  reads a
  reads b
  reads way
  drives l at 1.3 * b + way - 0.4
  drives r at 1.3 * b + 0.6 - way
  drives claw at 20 * a - 9
task World in arena size 30
  contains rock is obstacle grid 4 size 0.3 to 0.6 jitter 1.5
  contains coin is item size 2.5 count 9
  lasts 1000 ticks
  rewards progress toward coin per tick
  counts collision
"""
    rollout = Rollout(Policy(compile_text(text), {}), "World", "Go")
    assert follow(rollout, Engine(Policy(rollout.graph, {})), 1)["Collision"] > 0


def test_a_robot_begins_beside_a_fixed_box_along_either_axis() -> None:
    text = MIND.replace("TICKS", "1").replace("crate is box size 3 OUTCOME", "crate is box size 3 at 0 0")
    rollout = Rollout(Policy(compile_text(text.replace("OUTCOME", "")), {}), "World", "Push")
    tile = rollout.tile(128)
    rollout.fill(tile, rollout.jobs(np.zeros((1, 0), np.float32), np.arange(128, dtype=np.uint64)))
    beside = np.abs(tile.state.world.body[:2]) < 3  # along x, along y: its half, and the robot's own width
    assert beside.any(axis=1).tolist() == [True, True]
    assert not beside.all(axis=0).any()
