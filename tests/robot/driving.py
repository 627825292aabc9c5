"""`mindrun` that drives a robot of mock drivers: called in this process, or as one that is begun, watched, ended."""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from io import BytesIO
from pathlib import Path
from typing import Any

from mindrun.__main__ import main
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.robot.drivers.mock import MockActuator, MockSensor
from mindrun.terminal.standard_streams import Printable

from tests.robot.faults import MIND, SENSORS
from tests.sim.minds import compile_text

MINDRUN = (sys.executable, "-m", "mindrun")
NAME = f"mock {os.getpid()}"  # no other test of this computer drives it
PATIENCE = 600.0  # seconds; the simulator may have to be compiled
PROCEDURE = "procedure from own.f"


def wiring(value: float = 0.6, name: str = NAME) -> Wiring:
    """A robot of three actuators and a sensor that reads this value."""
    actuators = ("left_wheel", "right_wheel", "claw")
    sensor = SensorWire("sense", MockSensor(value), 0.0, 1.0)
    return Wiring(name, (sensor,), tuple(ActuatorWire(name, MockActuator()) for name in actuators))


def write_procedure(path: Path, source: str) -> None:
    """A bundle whose left wheel is driven by the function `f(sense, pulse)` of a module."""
    text = MIND.format(kind=SENSORS["bearing"][0], function=PROCEDURE)
    text = text.replace("left_wheel at 0.2 + pulse * 0.7", "left_wheel")
    write_bundle(path, Bundle(Policy(compile_text(text), {}), {"own": source}, wiring()))


def mindrun(*words: object) -> subprocess.CompletedProcess[str]:
    """It, to its end, in this process; what its guardian says goes elsewhere."""
    out, err = (Printable(BytesIO(), "utf-8", write_through=True) for _ in range(2))
    before, sys.argv = sys.argv, ["mindrun", *map(str, words)]
    try:
        with redirect_stdout(out), redirect_stderr(err):
            main()
    except SystemExit as end:
        said = (stream.buffer.getvalue().decode() for stream in (out, err))  # type: ignore[attr-defined]
        return subprocess.CompletedProcess(sys.argv, int(end.code or 0), *said)
    finally:
        sys.argv = before
    raise AssertionError("it has no end")


def program(*words: object, **more: Any) -> subprocess.CompletedProcess[str]:
    """It, to its end, in a process of its own."""
    caught = {"capture_output": True} if "stderr" not in more else {}
    return subprocess.run([*MINDRUN, *map(str, words)], text=True, check=False, timeout=PATIENCE, **caught, **more)


def begun(bundle: Path, day: Path, *words: object, **more: Any) -> "subprocess.Popen[str]":
    """One that drives, and has recorded some ticks."""
    process = subprocess.Popen([*MINDRUN, bundle, "--arm", "--record", day, *map(str, words)], text=True, **more)
    until(lambda: recorded(day), process)
    return process


def recorded(day: Path) -> bool:
    """Whether some ticks are in a recording."""
    return day.exists() and day.stat().st_size > 2000


def until(holds: Callable[[], object], process: "subprocess.Popen[str] | None" = None) -> None:
    """Wait until something is true, and for as long as the process lives."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        assert process is None or process.poll() is None
        time.sleep(0.02)


def children(pid: int, what: str) -> list[int]:
    """The processes that a process has started, and whose command line has these words."""
    said = subprocess.run(
        ["ps", "-ww", "-o", "pid=,args=", "--ppid", str(pid)], capture_output=True, text=True, check=False
    )
    return [int(line.split()[0]) for line in said.stdout.splitlines() if what in line]
