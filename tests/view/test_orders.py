"""Orders that are said on the page of a robot that drives: by the first who opened it, to the process that began it."""

import os
from pathlib import Path

import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, digest, write_bundle
from mindrun.robot.orders import Orders
from mindrun.robot.recording import About, Recorder

from mindlang.view.viewed_recording import followed_recording, viewed_recording
from tests.view.serving import served
from tests.view.test_following import write_rows
from tests.view.test_recording import mind

MIND = """
tick 1/20 s
master Go
body Rover is disc
actuator left is wheel side left neutral 0.5
sensor wanted is order 1 to 3
skill Go is mlp
  reads wanted
  drives left
"""
ORDERS = [{"name": "wanted", "node": 0, "choices": 3, "low": 1.0, "high": 3.0}]


def test_the_first_says_them_and_nobody_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rec, bundle, policy = tmp_path / "day.rec", tmp_path / "go.bundle", mind(MIND)
    write_bundle(bundle, Bundle(policy, {}))
    with Recorder(rec, About.of(policy.graph, digest(bundle), "Go", ("wanted",))) as recorder:
        write_rows(recorder, Engine(policy), 0, 3)
    orders = Orders(policy.graph)
    monkeypatch.setattr(os, "getppid", os.getpid)  # this process is the robot, too
    with orders.heard(lambda sentence: None), followed_recording(str(rec), bundle) as viewed, served(viewed) as view:
        with view.viewer() as first, view.viewer() as second:
            assert [each.hear("about")["orders"] for each in (first, second)] == [ORDERS, []]
            second.say(say="order", name="wanted", value=2)
            assert "somebody else" in second.hear("refused")["why"]
            first.say(say="order", name="wanted", value=4)
            assert first.hear("refused")["why"].startswith("wanted cannot be 4")
            assert orders.now("wanted") is None
            first.say(say="order", name="wanted", value=3)
            first.say(say="order", name="wnted", value=3)  # answered when the one before it has been
            first.hear("refused")
            assert orders.now("wanted") == 3
        with served(viewed_recording(rec, bundle)) as over, over.viewer() as viewer:
            assert viewer.hear("about")["orders"] == []
