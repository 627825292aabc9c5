"""The robot's mind: its shipped weights reach the ball with the sensors that a hobbyist can buy."""

import json

import pytest
from mindrun.graph.graph import Sensor
from mindrun.kinds.sensors.sensor import Physical

from mindlang.compiler.compile import load
from tests.calling import Call
from tests.language.examples import COLLECT

BALL = COLLECT.with_name("ball.mind")


def test_it_reaches_the_ball_without_a_collision(mindc: Call) -> None:
    said = mindc("bench", BALL, "--task", "Reach", "--runs", 200, "--seed", 1, "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["count_mean"] >= 0.9


def sensors() -> dict[str, Sensor]:
    graph = load(BALL).graph
    assert graph
    return {sensor.name: sensor for sensor in graph.sensors}


@pytest.mark.parametrize("name", ["proximity", "ball_bearing"])
def test_its_sensors_are_a_hobbyists(name: str) -> None:
    """What was asked for: noise, 60 ms of delay, 5 % lost echoes."""
    graph, kind = load(BALL).graph, sensors()[name].kind
    assert graph
    assert isinstance(kind, Physical)
    assert kind.noise > 0
    assert kind.delay * graph.tick >= 0.06
    assert name != "proximity" or kind.lost >= 0.05
