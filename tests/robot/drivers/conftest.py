"""Drivers on a machine that has other things to do."""

import pytest


@pytest.fixture(autouse=True)
def unhurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """The thread of a fake camera may wait for its turn for longer than a camera may for a frame."""
    monkeypatch.setattr("mindrun.robot.drivers.ball_tracker.MAX_FRAME_AGE_SECONDS", 5.0)
