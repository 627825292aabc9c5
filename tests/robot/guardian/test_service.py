"""The unit that systemd gets, and what it is told."""

import shutil
import socket
import subprocess
from pathlib import Path

import pytest
from mindrun.robot.guardian.service import Service, notify, unit

ROBOT = Service("rover", "/usr/bin/true run.bundle", "/usr/bin/true --neutral run.bundle", "/", user="root")


def test_it_moves_only_where_it_is_armed() -> None:
    assert "--arm" not in unit(ROBOT)
    assert "ExecStart=/usr/bin/true run.bundle --arm\n" in unit(
        Service("r", "/usr/bin/true run.bundle", "n", "/", arm=True)
    )


def test_it_is_watched_restarted_a_few_times_and_neutral_when_it_has_stopped() -> None:
    lines = unit(ROBOT).splitlines()
    for line in (
        "Type=notify",
        "WatchdogSec=2",
        "Restart=on-failure",
        "StartLimitBurst=3",
        "ExecStopPost=/usr/bin/true --neutral run.bundle",
        "NoNewPrivileges=yes",
        "ProtectSystem=strict",
        "DevicePolicy=closed",
        "DeviceAllow=char-i2c rw",
    ):
        assert line in lines


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="needs systemd-analyze")
def test_systemd_finds_nothing_wrong_with_it(tmp_path: Path) -> None:
    file = tmp_path / "mind.service"
    file.write_text(unit(ROBOT))
    done = subprocess.run(["systemd-analyze", "verify", "--man=no", str(file)], capture_output=True, text=True)
    assert [line for line in done.stderr.splitlines() if "mind.service" in line] == []


def test_systemd_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(str(tmp_path / "notify"))
        monkeypatch.setenv("NOTIFY_SOCKET", str(tmp_path / "notify"))
        notify("READY=1")
        assert manager.recv(99) == b"READY=1"


@pytest.mark.parametrize("address", [None, "", "/nowhere/at/all", "@nobody"])
def test_nobody_to_tell_is_fine(monkeypatch: pytest.MonkeyPatch, address: str | None) -> None:
    monkeypatch.delenv("NOTIFY_SOCKET", raising=False)
    if address is not None:
        monkeypatch.setenv("NOTIFY_SOCKET", address)
    notify("WATCHDOG=1")
