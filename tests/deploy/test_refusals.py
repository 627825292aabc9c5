"""What is refused changes nothing on the robot."""

import shutil
from pathlib import Path

import pytest

from tests.calling import Call
from tests.deploy.conftest import write
from tests.deploy.robot import HOST, FakeRobot

Bundles = tuple[Path, Path, Path]


@pytest.mark.parametrize("file", ["SHA256SUMS", "engine.py"])
def test_a_damaged_transfer(file: str, old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("truncate", file)
    said = mindc("deploy", bundles[1], HOST, "--watch", 0)
    assert said.code == 1
    assert "what arrived is not what was sent" in said.err
    assert robot.current() == old
    assert robot.releases() == [old]
    assert robot.log("systemctl.log") == []


def test_a_transfer_that_breaks_off(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("break", 5)
    said = mindc("deploy", bundles[1], HOST, "--watch", 0)
    assert said.code == 1
    assert "broke off" in said.err
    assert robot.current() == old


def test_a_bundle_that_the_robot_cannot_read(
    old: str, robot: FakeRobot, bundles: Bundles, mindc: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    from mindlang.robot import deployment

    runtime = dict(deployment._runtime())
    runtime["runtime/mindrun/graph/bundle.py"] += b"\nraise SyntaxError('a newer Python')\n"
    monkeypatch.setattr(deployment, "_runtime", lambda: iter(runtime.items()))
    said = mindc("deploy", bundles[1], HOST, "--watch", 0)
    assert said.code == 1
    assert "cannot be read by the Python of this robot" in said.err
    assert robot.current() == old


def test_a_file_that_is_no_bundle(robot: FakeRobot, tmp_path: Path, mindc: Call) -> None:
    path = tmp_path / "no.bundle"
    path.write_text("no")
    assert mindc("deploy", path, HOST).code == 2
    assert mindc("deploy", tmp_path / "none.bundle", HOST).code == 2
    assert robot.log("ssh.log") == []


def test_a_bundle_without_wiring_has_no_service(old: str, robot: FakeRobot, tmp_path: Path, mindc: Call) -> None:
    path = write(tmp_path, "Roam", wired=False)
    said = mindc("deploy", path, HOST)
    assert said.code == 1
    assert "--no-service" in said.err
    assert robot.log("ssh.log") == []
    assert mindc("deploy", path, HOST, "--no-service").code == 0
    assert robot.current() != old
    assert not robot.unit.exists()


def test_a_host_that_is_not_there(robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    said = mindc("deploy", bundles[0], "pi@unreachable")
    assert said.code == 1
    assert "pi@unreachable cannot be reached" in said.err


def test_a_robot_that_lacks_something(robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    robot.tell("no-systemd")
    said = mindc("deploy", bundles[0], HOST)
    assert (said.code, "--no-service" in said.err) == (1, True)
    (robot.root / "robot" / "rsync").unlink()
    said = mindc("deploy", bundles[0], HOST)
    if shutil.which("rsync", path="/usr/bin:/bin") is None:
        assert "lacks rsync" in said.err
    assert not robot.mind.exists()


def test_a_workstation_without_rsync(
    robot: FakeRobot, bundles: Bundles, mindc: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    (robot.root / "bin" / "rsync").unlink()
    monkeypatch.setenv("PATH", str(robot.root / "bin"))
    said = mindc("deploy", bundles[0], HOST)
    assert said.code == 1
    assert "rsync is not installed here" in said.err


def test_a_damaged_release_is_not_gone_back_to(old: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    assert mindc("deploy", bundles[1], HOST, "--watch", 0).code == 0
    (robot.mind / "releases" / old / "mind.bundle").write_bytes(b"")
    said = mindc("deploy", HOST, "--rollback")
    assert said.code == 1
    assert robot.master() == "Chase"


@pytest.mark.parametrize("words", [[], ["a", "b", "c"], ["pi@robot"], ["pi@robot", "--list", "--rollback"]])
def test_wrong_usage(words: list[str], mindc: Call) -> None:
    assert mindc("deploy", *words).code == 2
