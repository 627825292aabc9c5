"""However a guardian, a driver or a controller ends: at neutral is what can be, and what is said to be."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from mindrun.robot.guardian.plan import to_json

from tests.robot.guardian.driven import PLAN
from tests.robot.guardian.ends import PATIENCE, PROGRAM, Round, rounds
from tests.robot.guardian.hostile import NEUTRALS


def test_random_ends(tmp_path: Path) -> None:
    assert len([*rounds(10, 8269, tmp_path, 4)]) == 10  # none hangs for the five seconds in which all is tried


@pytest.mark.parametrize(
    ("how", "when", "device"),
    [
        ("_exit 0", "open", "/dev/one"),
        ("SIGSEGV", "neutral", ""),
        ("group", "neutral", "/dev/one"),
        ("group", "open", ""),
    ],
)
def test_a_driver_that_ends_the_process_takes_no_other_along(tmp_path: Path, how: str, when: str, device: str) -> None:
    """Of one device they are opened together at first, since only one process may drive it."""
    log = tmp_path / "log"
    log.write_text("")
    manners = ["fine", f"{how}@{when}", "fine"]
    hostile = {"MIND_LOG": str(log), "MIND_MANNERS": ",".join(manners), "MIND_DEVICE": device}
    command = [sys.executable, "-P", str(PROGRAM), "--neutral", "-"]
    done = subprocess.run(
        command, input=to_json(PLAN), text=True, capture_output=True, env={**os.environ, **hostile}, check=False
    )
    assert done.returncode == 1
    assert done.stderr == "guardian: not known to be at neutral: right_wheel; cut the actuators' power\n"
    *said, last = done.stdout.splitlines()
    assert (sorted(said), last) == (["rest claw", "rest left_wheel"], "over")
    assert Round(manners, "", log).is_at_rest
    assert log.read_text().count(" harm 1 ") == 3


def test_what_a_driver_prints_keeps_nothing_moving(tmp_path: Path) -> None:
    """Where nobody reads it."""
    log = tmp_path / "log"
    log.write_text("")
    manners = ["print@neutral", "fine", "fine"]
    hostile = {"MIND_LOG": str(log), "MIND_MANNERS": ",".join(manners), "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, str(PROGRAM), "drive", "done", "0.2"]
    environment = {**os.environ, **hostile}
    with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as controller:
        controller.wait(PATIENCE)
    assert Round(manners, "", log).last == [*NEUTRALS]


@pytest.mark.slow
def test_1000_random_ends(tmp_path: Path) -> None:
    assert len([*rounds(1000, 4, tmp_path, 4)]) == 1000
