"""A drive taken apart: `mindc why drive.rec FILE --skills`."""

import json
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy

from mindlang.attribution.mixture import commands_of, mixtures, telling_readings
from mindlang.compiler.compile import load
from mindlang.run.drives import Drive
from tests.calling import Call

MIND = """tick 1/60 s
master Mixed
body Robot is disc size 2 density 2 linear_damping 5 angular_damping 20
actuator left_wheel is wheel side left thrust 80 neutral 0.5
actuator right_wheel is wheel side right thrust 80 neutral 0.5
actuator claw is gripper reach 1.5 neutral 0
sensor ball_bearing is bearing of ball
sensor near is distance of ball range 50
sensor pulse is sine period 1 s
skill Turn is rule
  reads ball_bearing
  drives left_wheel at ball_bearing
  drives right_wheel at 1 - ball_bearing
skill Rush is rule
  reads near
  drives left_wheel at near
  drives right_wheel at near
skill Wave is rule
  reads pulse
  drives left_wheel at pulse
  drives right_wheel at 1
skill Shut is rule
  reads pulse
  drives claw at pulse
skill Mixed is rule
  influences Turn at 0.6
  influences Rush at 0.2
  influences Shut at 0.5
task Find in plain
  contains ball is item size 2 reached moves
  lasts 300 ticks
  counts reach of ball
"""


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mind of rules, as a file in the working folder."""
    monkeypatch.chdir(tmp_path)
    found = Path("mixed.mind")
    found.write_text(MIND)
    return found


def driven(graph: Graph, shares: np.ndarray, unknown: slice = slice(0)) -> tuple[Drive, dict[str, np.ndarray]]:
    """A drive whose wheels got a mixture [ticks, 3] of skills, and what these send; pulse alone tells the unknown."""
    rng, ticks = np.random.default_rng(2), len(shares)
    readings = rng.random((ticks, graph.width)).astype(np.float32)
    nothing = np.zeros((ticks, len(graph.skills)), np.float32)
    drive = Drive("made.rec", "", 0, "Find", readings, nothing, np.zeros((ticks, 3), np.float32))
    sent = commands_of(Policy(graph, {}), {}, drive)
    drive.commands[:, :2] = sum(shares[:, [n]] * sent[name][:, :2] for n, name in enumerate(("Turn", "Rush", "Wave")))
    place = next(sensor.start for sensor in graph.sensors if sensor.name == "pulse")
    drive.commands[unknown, :2] = readings[unknown, place][:, None] ** 2
    drive.commands[:, 2] = sent["Shut"][:, 2]
    return drive, sent


def test_a_known_mixture_is_found(path: Path) -> None:
    """Shares that change from span to span, of skills of which two drive the wheels, and another alone the claw."""
    graph = load(path).graph
    assert graph
    rng = np.random.default_rng(1)
    of_spans = rng.dirichlet([0.5, 0.5, 0.5], 60).cumsum(axis=0) / np.arange(1, 61)[:, None]
    drive, sent = driven(graph, np.repeat(of_spans, 6, axis=0))
    wheels, claw = mixtures(graph, drive, sent)
    assert (wheels.actuators, claw.actuators) == (("left_wheel", "right_wheel"), ("claw",))
    assert wheels.left_over == 0
    found = np.array([[span.shares[name] for name in ("Turn", "Rush", "Wave")] for span in wheels.spans])[1::3]
    assert np.abs(found - of_spans).max() < 0.05
    assert claw.share("Shut") == 1


def test_what_no_skill_does_is_left_over(path: Path) -> None:
    """The stretch that somebody else drove, and the sensor by which it can be told."""
    graph = load(path).graph
    assert graph
    drive, sent = driven(graph, np.tile([0.5, 0.5, 0.0], (360, 1)), slice(120, 240))
    wheels = mixtures(graph, drive, sent)[0]
    assert wheels.left_over == pytest.approx(1 / 3, abs=0.02), "some of it is a mean of skills by chance"
    left = [each for each in wheels.stretches() if not each.by]
    assert (left[0].first, left[-1].end) == (120, pytest.approx(238, abs=2))
    assert telling_readings(graph, drive, wheels) == ["pulse"]


def test_a_recorded_run_is_taken_apart(mindc: Call, path: Path) -> None:
    assert mindc("run", path, "--record", "day.rec", "-q").code == 0
    wheels, claw = json.loads(mindc("why", "day.rec", path, "--skills", "--json").out)
    shares = {"Turn": 0.75, "Rush": 0.25, "Wave": 0.0}
    assert wheels["skills"] == {name: pytest.approx(share, abs=0.05) for name, share in shares.items()}
    assert (wheels["ticks"], wheels["left_over"], claw["skills"]) == ([1, 300], 0, {"Shut": 1})
    said = mindc("why", "day.rec", path, "--skills")
    assert max(map(len, said.out.splitlines())) <= 80
    assert "A" * 76 in said.out
    assert "is of a recording and a mind" in mindc("why", path, "--skills").err
