"""A robot to deploy to, and what is deployed."""

import os
from pathlib import Path

import pytest
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.named_readings import physical
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.robot.drivers.mock import MockActuator, MockSensor

from mindlang.compiler.compile import load
from tests.calling import write_rules
from tests.deploy.robot import FakeRobot, copy, deployed, make_robot


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FakeRobot:
    """A robot on which nothing was ever deployed, and ssh and rsync that know the way to it."""
    robot = make_robot(tmp_path / "robot")
    monkeypatch.setenv("FAKE", str(robot.root))
    monkeypatch.setenv("PATH", f"{robot.root}/bin{os.pathsep}{os.environ['PATH']}")
    return robot


@pytest.fixture(scope="session")
def template(tmp_path_factory: pytest.TempPathFactory, bundles: tuple[Path, Path, Path]) -> FakeRobot:
    """A robot that has one release, with Roam in charge; for copies."""
    robot = make_robot(tmp_path_factory.mktemp("template") / "robot")
    assert deployed(robot, bundles[0]) == 0
    robot.forget("systemctl.log", "ssh.log", "steps")
    return robot


@pytest.fixture
def old(robot: FakeRobot, template: FakeRobot) -> str:
    """The release that the robot has already, with Roam in charge."""
    copy(template, robot)
    return robot.current()


@pytest.fixture(scope="session")
def bundles(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path]:
    """Three wired bundles that differ in who is in charge: Roam, Chase and Turn."""
    folder = tmp_path_factory.mktemp("bundles")
    return tuple(write(folder, master) for master in ("Roam", "Chase", "Turn"))  # type: ignore[return-value]


def write(folder: Path, master: str, wired: bool = True) -> Path:
    """A bundle of the small mind with one of its skills in charge."""
    source = write_rules(folder)
    source.write_text(source.read_text().replace("master Roam", f"master {master}"))
    graph = load(source).graph
    assert graph is not None
    path = folder / f"{master}.bundle"
    names = physical(graph)
    sensors = tuple(SensorWire(s.name, MockSensor(0.5, s.width), 0.0, 1.0) for s in graph.sensors if s.name in names)
    actuators = tuple(ActuatorWire(a.name, MockActuator()) for a in graph.actuators)
    write_bundle(path, Bundle(Policy(graph, {}), {}, Wiring("ball", sensors, actuators) if wired else None))
    return path
