"""Worlds in which everything stands, and a robot that means to: what random robots seldom bring about."""

from collections import Counter
from collections.abc import Sequence

import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.following import follow
from tests.sim.minds import compile_text

MIND = """
tick 1/60 s
master Work
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 300
actuator right_wheel is wheel side right neutral 0.5 thrust 300
actuator claw is gripper neutral 0
sensor ball_bearing is bearing of ball
sensor coin_bearing is bearing of coin
sensor home_bearing is bearing of home
sensor ball_near is contact of ball
sensor coin_near is contact of coin
sensor has_ball is held of ball
sensor has_coin is held of coin
sensor in_home is inside of home
sensor eyes is range_finder at -40 0 40 deg range 9
sensor back is range_finder at 150 210 deg range 20
sensor charge is battery start 60% drain 0.001 charge 0.004
sensor moving is inertial
sensor beat is sine period 7 s
skill Work is rule
  reads beat
  influences Ball at 20 * (beat - 0.5)
  influences Coin at 20 * (0.5 - beat)
skill Ball is rule
  reads ball_bearing
  reads home_bearing
  reads ball_near
  reads has_ball
  reads in_home
  drives left_wheel at 0.8 + 4 * (ball_bearing - 0.5) * (1 - has_ball) + 4 * (home_bearing - 0.5) * has_ball
  drives right_wheel at 0.8 - 4 * (ball_bearing - 0.5) * (1 - has_ball) - 4 * (home_bearing - 0.5) * has_ball
  drives claw at CLAW
skill Coin is rule
  reads coin_bearing
  reads home_bearing
  reads coin_near
  reads has_coin
  reads in_home
  reads eyes
  reads back
  drives left_wheel at 0.8 + 4 * (coin_bearing - 0.5) * (1 - has_coin) + 4 * (home_bearing - 0.5) * has_coin
  drives right_wheel at 0.8 - 4 * (coin_bearing - 0.5) * (1 - has_coin) - 4 * (home_bearing - 0.5) * has_coin
  drives claw at coin_near + has_coin - in_home
task World in arena size 50
  contains ball is item size 1 to 3 by 0.5 OUTCOME
  contains home is zone size 9
  contains rock is obstacle grid 17 size 1 to 3 jitter 1.5
  contains coin is item size 4 to 1 by 0.75
  contains plug is power size 12 to 6 by 2 reached moves
  lasts 1000 ticks
  rewards forward per tick
  rewards 0.1 * progress toward coin per tick when moving > 0.1
  rewards (1 - p) per tick for each p in eyes when p < 1/4
  rewards -(1 - p) per tick for each p in back when p < 1/2
  rewards charge per tick
  rewards 2 on visit of patch size 5
  counts reach of ball
  counts reach of coin
  counts reach of plug
  counts delivery of ball
  counts delivery of coin
  counts collision
"""


@pytest.mark.parametrize(("outcome", "seeds"), [("", (1, 16)), ("reached moves", (6,))])
def test_every_tick_is_what_plain_python_says(outcome: str, seeds: Sequence[int]) -> None:
    graph = compile_text(MIND.replace("CLAW", "ball_near + has_ball - in_home").replace("OUTCOME", outcome))
    happened = Counter[str]()
    for seed in seeds:
        happened += follow(Rollout(Policy(graph, {}), "World", "Work"), Engine(Policy(graph, {})), seed)
    assert happened["Reach"] > 5
    assert happened["Delivery"] > 1
    assert happened["Visit"] > 20
    assert happened["Collision"] > 1


def test_a_claw_that_is_half_closed_is_open() -> None:
    graph = compile_text(MIND.replace("CLAW", "0.5").replace("OUTCOME", ""))
    held = {
        moment.held for seed in range(3) for moment in trace(Rollout(Policy(graph, {}), "World", "Ball"), seed).moments
    }
    assert held == {-1}
