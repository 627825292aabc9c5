"""A robot tells of a promise that is broken, and stops where robot.yaml says so."""

from dataclasses import replace

import pytest
from mindrun.engine.changes import ChangedEngine
from mindrun.engine.promises import PromiseWatcher
from mindrun.graph.graph import Promise
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import SensorWire
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.sensing import ReadingFilter, Sampler

from tests.minds import always, mind, rule
from tests.robot.faults import TICK, Clock, Scripted, Sent

ABOVE_HALF = (("reading", 0), ("number", 0.5), (">", 0))


@pytest.mark.parametrize(
    ("word", "stops", "told", "stopped"),
    [
        ("requires", True, ["Go requires: broken by those above it"] * 2, [0, 1, 1, 0, 1]),
        ("maintains", True, ["Go maintains: broken"] * 2, [0, 1, 1, 0, 1]),
        ("maintains", False, ["Go maintains: broken"] * 2, [0] * 5),
    ],
)
def test_a_broken_promise_is_told_once_until_it_held(
    word: str, stops: bool, told: list[str], stopped: list[int]
) -> None:
    go = replace(rule("Go", always("actuator", 0, 1.0), reads=(0,)), promises=(Promise(word, word, ABOVE_HALF),))
    of, clock, said = mind(go), Clock(), list[str]()
    sampler = Sampler(SensorWire("r0", Scripted(1, [[0.9], [0.1], [0.2], [0.8], [0.3]]), 0.0, 1.0), clock)
    senses, pace = ReadingFilter(of, [sampler]), Rate(TICK, clock, clock.sleep)
    loop = Loop(ChangedEngine(Policy(of, {})), senses, Sent(), pace, True, tell=said.append)
    loop.promises, loop.stops_on_broken = PromiseWatcher(of, "Go"), stops
    loop.pace.begin()
    device, done = None, []
    for _ in stopped:
        device, sampler.latest = sampler._measured(device)
        before = loop.stopped
        loop.tick()
        done.append(loop.stopped - before)
    assert (said, done) == (told, stopped)
