"""A robot that has said how it is wired."""

from pathlib import Path

import pytest
from mindrun.bundle import Bundle, write_bundle
from mindrun.policy import Policy
from mindrun.robot.identity import adopt

from tests.robot.driving import wiring
from tests.robot.faults import graph


@pytest.fixture
def bundle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A bundle that this robot is wired for."""
    monkeypatch.setenv("MIND_ROBOT", str(tmp_path / "robot" / "identity"))
    path = tmp_path / "mind.bundle"
    write_bundle(path, Bundle(Policy(graph("bearing"), {}), {}, wiring()))
    adopt(wiring(), graph("bearing"))
    return path
