"""Whenever a deployment ends, the robot has the old release or the new one, whole."""

import json
import os
import random
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.calling import Call
from tests.deploy.robot import HOST, FakeRobot, copy, deployed, make_robot, program

Bundles = tuple[Path, Path, Path]
SEED = 20261121


def settled(robot: FakeRobot) -> None:
    """Wait for a robot that lived on, until it has finished what it was doing."""
    (robot.mind / "lock").touch()
    while subprocess.run(["flock", "-n", robot.mind / "lock", "true"]).returncode:
        time.sleep(0.02)


def killed_at_random(robot: FakeRobot, bundle: Path, moment: float) -> bool:
    """Start a deployment, and end it and all that it started at a moment; whether it was still going on."""
    process = program(robot, "deploy", bundle, HOST, "--watch", 0)
    time.sleep(moment)
    going_on = process.poll() is None
    if going_on:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate(timeout=600)
    settled(robot)
    robot.clean()
    return going_on


def interrupt(robot: FakeRobot, bundles: Bundles, times: int) -> dict[str, int]:
    """Interrupt deployments of one bundle after the other; how often the old or the new release was current then."""
    draw = random.Random(SEED)
    begin = time.monotonic()
    assert deployed(robot, bundles[1]) == 0
    duration = time.monotonic() - begin
    counts = {"old": 0, "new": 0, "late": 0}
    while counts["old"] + counts["new"] < times:
        old, old_master = robot.current(), robot.master()
        bundle = next(each for each in bundles if each.stem != old_master)
        lives_on = draw.random() < 0.5
        robot.tell("lives-on") if lives_on else robot.forget("lives-on")
        going_on = killed_at_random(robot, bundle, draw.uniform(0.2, 1.1) * duration)
        now = robot.current()  # which asserts that it is whole
        assert robot.master() == (old_master if now == old else bundle.stem)
        counts["late" if not going_on else "old" if now == old else "new"] += 1
    robot.forget("lives-on")
    assert deployed(robot, bundles[2]) == 0
    assert robot.master() == bundles[2].stem
    assert len(robot.releases()) <= 3
    return counts


def steps_of(robot: FakeRobot, bundle: Path) -> int:
    """How many steps a deployment has on the robot."""
    assert deployed(robot, bundle) == 0
    return len(robot.log("steps"))


def killed_at_step(template: FakeRobot, folder: Path, bundle: Path, step: int, when: str) -> str:
    """End everything before or after one step on a copy of a robot; who is in charge after that."""
    robot = copy(template, FakeRobot(folder / f"{step}{when}"))
    robot.tell("kill", f"{step} {when}\n")
    assert deployed(robot, bundle) != 0
    robot.clean()
    return robot.master()


def check_steps(first: FakeRobot, folder: Path, bundles: Bundles, every: int) -> list[FakeRobot]:
    """End a deployment at every so many of its steps, from the last to the first: first the new one is current."""
    trial = copy(first, FakeRobot(folder / "trial"))
    moments = [(step, when) for step in range(1, steps_of(trial, bundles[1]) + 1) for when in ("before", "after")]
    masters = [killed_at_step(first, folder, bundles[1], *moment) for moment in moments[::-every]]
    assert set(masters) == {"Roam", "Chase"}
    assert masters == sorted(masters)
    return [FakeRobot(folder / f"{step}{when}") for step, when in moments[::-every]]


def test_a_few_steps(template: FakeRobot, tmp_path: Path, bundles: Bundles) -> None:
    check_steps(template, tmp_path, bundles, 36)


def test_in_the_middle_of_copying(old: str, robot: FakeRobot, bundles: Bundles) -> None:
    robot.tell("kill-copy", 7)
    assert deployed(robot, bundles[1]) == -signal.SIGKILL
    robot.clean()
    assert robot.current() == old


def test_what_was_never_current_is_not_gone_back_to(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("kill", "mv:1 after\n")  # what was accepted is a release now
    assert deployed(robot, bundles[1]) != 0
    robot.forget("kill")
    robot.clean()
    states = [each["state"] for each in json.loads(mindc("deploy", HOST, "--list", "--json").out)["releases"]]
    assert states == ["whole", "unused"]
    assert mindc("deploy", bundles[2], HOST, "--watch", 0).code == 0
    assert mindc("deploy", HOST, "--rollback", "--watch", 0).code == 0
    assert robot.current() == old


@pytest.mark.slow
def test_a_hundred_moments(old: str, robot: FakeRobot, bundles: Bundles) -> None:
    print(interrupt(robot, bundles, 100))


@pytest.mark.slow
def test_every_step(template: FakeRobot, tmp_path: Path, bundles: Bundles) -> None:
    for robot in check_steps(template, tmp_path, bundles, 1):
        robot.forget("kill")
        assert deployed(robot, bundles[1]) == 0  # the same command goes on
        assert robot.master() == "Chase"


@pytest.mark.slow
@pytest.mark.skipif(not Path("/usr/bin/rsync").exists(), reason="there is no rsync here")
def test_with_the_real_rsync(tmp_path: Path, bundles: Bundles) -> None:
    robot = make_robot(tmp_path / "real", rsync=True)
    interrupt(robot, bundles, 10)


def test_ctrl_c(old: str, robot: FakeRobot, bundles: Bundles) -> None:
    robot.tell("lives-on")
    process = program(robot, "deploy", bundles[1], HOST, "--watch", 1)
    while process.poll() is None and not any(line.startswith("start") for line in robot.log("systemctl.log")):
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGINT)
    said, _ = process.communicate(timeout=600)
    assert process.returncode == 130
    assert "The same command goes on" in said
    assert "Traceback" not in said
    settled(robot)
    assert robot.master() == "Chase"
