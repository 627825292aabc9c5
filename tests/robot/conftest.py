"""A robot that has said how it is wired."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.ownership import DrivenError, adopt, hold_devices

from tests.robot.driving import children, until, wiring
from tests.robot.faults import MIND, SENSORS, graph
from tests.sim.minds import compile_text


@pytest.fixture
def quick(bundle: Path) -> Path:
    """The bundle, whose task lasts a second."""
    text = MIND.format(kind=SENSORS["bearing"][0], function="rule").replace("lasts 100 ticks", "lasts 20 ticks")
    write_bundle(bundle, Bundle(Policy(compile_text(text), {}), {}))
    return bundle


@pytest.fixture
def bundle(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A bundle that this robot is wired for. Nobody drives it any more when the test ends, even where that fails."""
    monkeypatch.setenv("MIND_ROBOT", str(tmp_path / "robot" / "identity"))
    path = tmp_path / "mind.bundle"
    write_bundle(path, Bundle(Policy(graph("bearing"), {}), {}, wiring()))
    adopt(wiring(), graph("bearing"))
    yield path
    for pid in children(os.getpid(), str(path)):
        os.kill(pid, signal.SIGKILL)
    until(is_free)


def is_free() -> bool:
    """Whether nobody drives the robot: a guardian that was left lets it go once all is at neutral."""
    try:
        with hold_devices(wiring()):
            return True
    except DrivenError:
        return False
