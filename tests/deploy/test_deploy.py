"""Releases come, are switched to, are left again, and go."""

import json
import re
from pathlib import Path

from tests.calling import Call
from tests.deploy.robot import HOST, FakeRobot

Bundles = tuple[Path, Path, Path]
NOW = ("--watch", 0)


def test_the_first_deployment(robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    said = mindc("deploy", bundles[0], HOST, *NOW, "--json")
    assert said.code == 0, said.err
    done = json.loads(said.out)
    assert done["release"] == robot.current()
    assert done["before"] is None
    assert done["service"] == {"unit": "mind.service", "armed": False}
    assert re.fullmatch(r"\d{8}T\d{6}Z-[0-9a-f]{8}", robot.current())
    assert (robot.mind / "current" / "mind.bundle").read_bytes() == bundles[0].read_bytes()
    assert [line.split()[0] for line in robot.log("systemctl.log")] == [
        "daemon-reload",
        "enable",
        "reset-failed",
        "start",
    ]
    assert not list(robot.mind.rglob("__pycache__"))
    assert not (robot.mind / "current" / "runtime" / "mindrun" / "sim").exists()


def test_the_next_one_and_back_again(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    """What was left is never gone back to, and what a name stands for is on the disk before it."""
    assert mindc("deploy", bundles[1], HOST, *NOW).code == 0
    steps = robot.log("steps")
    moves = [number for number, step in enumerate(steps) if step.startswith("mv")]
    assert len(moves) == 3  # the service, the release, current
    assert all(steps[number - 1].startswith("sync") for number in moves)
    stopped = [line for line in robot.log("systemctl.log") if line.startswith("stop")]
    assert [old.partition("-")[2]] == [line.split()[1] for line in stopped]
    for words, master in (((HOST, "--rollback"), "Roam"), ((bundles[2], HOST), "Turn"), ((HOST, "--rollback"), "Roam")):
        assert mindc("deploy", *words, *NOW).code == 0
        assert robot.master() == master
    said = mindc("deploy", HOST, "--rollback", *NOW)
    assert said.code == 1
    assert "no whole release before" in said.err
    states = [each["state"] for each in json.loads(mindc("deploy", HOST, "--list", "--json").out)["releases"]]
    assert states == ["whole", "left"]  # what was left before is gone
    assert "→" in mindc("deploy", HOST, "--list").out


def test_armed_only_by_the_last_command(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("break", 0)  # the same again copies nothing
    said = mindc("deploy", bundles[0], HOST, "--arm-service", *NOW)
    assert (said.code, "already" in said.err, robot.releases()) == (0, True, [old])
    robot.forget("break")
    assert "--arm\n" in robot.unit.read_text()
    mindc("deploy", bundles[0], HOST, *NOW)
    assert "--arm" not in robot.unit.read_text()
    mindc("deploy", bundles[2], HOST, "--arm-service", *NOW)
    mindc("deploy", HOST, "--rollback", *NOW)
    assert "--arm" not in robot.unit.read_text()
    mindc("deploy", bundles[0], HOST, "--no-service", *NOW)
    assert not robot.unit.exists()


def test_a_release_that_does_not_run_is_left(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("broken", "\n".join(name_of_next(robot, bundles[1], mindc)))
    said = mindc("deploy", bundles[1], HOST, "--arm-service", *NOW)
    assert said.code == 1
    assert f"It is back with {old}" in said.err
    assert robot.current() == old
    assert "--arm" not in robot.unit.read_text()  # the old one was not armed


def name_of_next(robot: FakeRobot, bundle: Path, mindc: Call) -> list[str]:
    """All names that a release of this bundle may get within a minute."""
    err = mindc("deploy", bundle, HOST, "--dry-run").err
    found = re.search(r"as (\d{8}T\d{4})\d\dZ-(\w{8})", err)
    assert found
    minute = int(found[1][-2:])
    minutes = [f"{found[1][:-2]}{m:02}" for m in (minute, minute + 1)]
    return [f"{start}{second:02}Z-{found[2]}" for start in minutes for second in range(60)]


def test_one_may_stay_with_what_does_not_run(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("broken", "all")
    said = mindc("deploy", bundles[1], HOST, "--no-auto-rollback", *NOW)
    assert said.code == 1
    assert "--rollback goes back" in said.err
    assert robot.master() == "Chase"


def test_a_dry_run_changes_nothing(robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    said = mindc("deploy", bundles[0], HOST, "--dry-run")
    assert said.code == 0
    assert "would copy" in said.err
    assert not robot.mind.exists()
