"""The service: what runs, and what never does unasked."""

import configparser
import shutil
import subprocess
from pathlib import Path

import pytest

from mindlang.robot.deployment import unit


def read(text: str) -> configparser.ConfigParser:
    """A unit as sections of settings."""
    parser = configparser.ConfigParser(interpolation=None, delimiters=("=",))
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    parser.read_string(text)
    return parser


def test_not_armed_it_moves_nothing() -> None:
    service = read(unit())["Service"]
    assert service["ExecStart"].endswith("-m mindrun mind.bundle")
    assert "ExecStopPost" not in service


def test_armed_it_ends_in_neutral() -> None:
    service = read(unit(arm=True))["Service"]
    assert service["ExecStart"].endswith("-m mindrun mind.bundle --arm")
    assert service["ExecStopPost"].endswith("-P -m mindrun.robot.guardian --neutral mind.bundle")


@pytest.mark.parametrize("arm", [False, True])
def test_it_is_watched_and_only_the_controller_is_told_to_end(arm: bool) -> None:
    service = read(unit(arm))["Service"]
    assert (service["Type"], service["WatchdogSec"], service["KillMode"]) == ("notify", "2", "mixed")


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="needs systemd-analyze")
def test_systemd_finds_nothing_wrong_with_it(tmp_path: Path) -> None:
    file = tmp_path / "mind.service"
    file.write_text(unit(arm=True).replace("%h/mind/venv/bin/python", "/usr/bin/true").replace("%h/mind/current", "/"))
    done = subprocess.run(
        ["systemd-analyze", "verify", "--user", "--man=no", str(file)], capture_output=True, text=True
    )
    assert [line for line in done.stderr.splitlines() if "mind.service" in line] == []


def test_both_go_on_after_a_failure() -> None:
    for arm in (False, True):
        parser = read(unit(arm))
        assert parser["Service"]["Restart"] == "on-failure"
        assert parser["Install"]["WantedBy"] == "default.target"
