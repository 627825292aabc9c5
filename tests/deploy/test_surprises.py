"""What people do on a robot by hand, and two of them at once: said, and the next deployment goes on."""

import os
import shutil
import signal
import subprocess
import time
from datetime import UTC, datetime
from pathlib import Path

import pytest

from mindlang.robot.deployment import parse_state
from mindlang.robot.remote import script
from tests.calling import Call
from tests.deploy.robot import HOST, FakeRobot, program

Bundles = tuple[Path, Path, Path]
NOW = ("--watch", 0)
FOREIGN = ["backup", "lost+found", "my releases", "20261121", "20261121T193404Z-xyzxyzxy"]


def test_folders_of_others_stay_and_disturb_nothing(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    for name in FOREIGN:
        (robot.mind / "releases" / name).mkdir()
    (robot.mind / "releases" / "notes.txt").write_text("mine")
    for bundle in bundles[1:]:
        said = mindc("deploy", bundle, HOST, "--keep", 2, *NOW)
        assert said.code == 0, said.err
    assert robot.master() == "Turn"
    assert {"notes.txt", *FOREIGN} < {*robot.releases()}
    assert len(robot.releases()) == len(FOREIGN) + 3, "two are kept"
    assert not list((robot.mind / "incoming").iterdir())
    assert mindc("deploy", HOST, "--rollback", *NOW).code == 0
    assert robot.master() == "Chase"
    assert len(mindc("deploy", HOST, "--list").out.splitlines()) == 2


def test_a_current_release_that_was_deleted_is_told_and_another_takes_its_place(
    old: str, robot: FakeRobot, bundles: Bundles, mindc: Call
) -> None:
    assert mindc("deploy", bundles[1], HOST, *NOW).code == 0
    shutil.rmtree(robot.mind / "releases" / robot.current())
    said = mindc("deploy", HOST, "--rollback", *NOW)
    assert (said.code, "has been deleted on" in said.err) == (0, True), said.err
    assert robot.current() == old
    shutil.rmtree(robot.mind / "releases" / old)
    said = mindc("deploy", bundles[2], HOST, *NOW)
    assert (said.code, f"the current release, {old}, has been deleted" in said.err) == (0, True), said.err
    assert robot.master() == "Turn"


@pytest.mark.parametrize("number", ["99999999999999999999", "-1", "", "3x"])
def test_no_number_that_sh_cannot_compare_removes_a_release(old: str, robot: FakeRobot, number: str) -> None:
    (robot.mind / "releases" / old / "WAS").touch()
    done = subprocess.run(
        [robot.root / "bin" / "ssh", "--", HOST, "sh -s"],
        input=script("switch", [old, "none", number, "0", "no", ""]),
        capture_output=True,
        check=False,
    )
    assert b"refused\tit cannot keep" in done.stdout
    assert robot.releases() == [old]


def test_of_two_at_once_one_waits(old: str, robot: FakeRobot, bundles: Bundles) -> None:
    both = [program(robot, "deploy", bundle, HOST, *NOW) for bundle in bundles[1:]]
    said = [process.communicate(timeout=600)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0], said
    assert len(robot.releases()) == 3
    assert robot.master() in {"Chase", "Turn"}


def test_of_one_bundle_twice_at_once_both_are_right(old: str, robot: FakeRobot, bundles: Bundles) -> None:
    both = [program(robot, "deploy", bundles[1], HOST, *NOW) for _ in range(2)]
    said = [process.communicate(timeout=600)[0] for process in both]
    assert [process.returncode for process in both] == [0, 0], said
    assert sum("has this release already" in each for each in said) == 1
    assert len(robot.releases()) == 2


def test_who_waits_too_long_is_refused_in_words(
    old: str, robot: FakeRobot, bundles: Bundles, mindc: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = script
    monkeypatch.setattr(
        "mindlang.robot.remote.script",
        lambda verb, words: whole(verb, words).replace(b"patience=60", b"patience=0"),
    )
    holder = subprocess.Popen(["flock", robot.mind / "deploying", "cat"], stdin=subprocess.PIPE)
    try:
        time.sleep(0.5)
        said = mindc("deploy", bundles[1], HOST, *NOW)
    finally:
        holder.communicate()
    assert said.code == 1
    assert "waiting for up to a minute" in said.out + said.err
    assert "another deployment is under way" in said.err
    assert "Nothing has changed there" in said.err
    assert robot.releases() == [old]


def test_who_was_killed_keeps_nobody_waiting(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("lives-on")
    process = program(robot, "deploy", bundles[1], HOST, "--watch", 30)
    while process.poll() is None and not any(line.startswith("start") for line in robot.log("systemctl.log")):
        time.sleep(0.02)
    with process:  # the workstation alone is waited for: the robot watches the service for half a minute
        os.killpg(process.pid, signal.SIGKILL)
    robot.clean()
    subprocess.run(["flock", "-w", "20", robot.mind / "deploying", "true"], check=True)


@pytest.mark.parametrize("detail", ["", "a", "a b", "backup whole {}", "99999999T999999Z-00000000 whole {}"])
def test_what_a_robot_tells_of_something_else_is_left_out(detail: str) -> None:
    assert parse_state([("release", detail), ("current", "/")]).releases == ()
    assert parse_state([("current", "backup")]).current == ""


def test_no_release_has_a_name_after_the_last_year() -> None:
    last = "99991231T235959Z-00000000"
    state = parse_state([("current", last), ("release", f"{last} whole {{}}")])
    assert state.moment(datetime(2026, 11, 21, tzinfo=UTC)) == "20261121T000000Z"
