"""One robot has one driver, whatever happens to files, and whoever starts the second."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring, still
from mindrun.robot.drivers.ball_tracker import BallTracker
from mindrun.robot.drivers.grove_motor import GroveMotor
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.drivers.pca9685 import Pca9685
from mindrun.robot.drivers.simulated import SimulatedActuator
from mindrun.robot.ownership import DrivenError, claims, hold_devices
from mindrun.robot.recording import read

from tests.robot.driving import MINDRUN, NAME, begun, children, mindrun, program, recorded, until, write_procedure


def test_whatever_happens_to_files_nobody_drives_beside(
    bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = begun(bundle, tmp_path / "day.rec", stderr=subprocess.PIPE)

    def is_alone() -> None:
        mindrun("adopt", bundle)
        for words in (("--arm",), ()):
            said = mindrun(bundle, *words, "--ticks", 2)
            assert said.returncode == 2
            assert f"this robot is driven already, by process {first.pid}" in said.stderr

    is_alone()
    robot, elsewhere = tmp_path / "robot", tmp_path / "elsewhere"
    shutil.copytree(robot, elsewhere)
    monkeypatch.setenv("MIND_ROBOT", str(elsewhere / "identity"))
    is_alone()
    monkeypatch.setenv("MIND_ROBOT", str(robot.rename(tmp_path / "moved") / "identity"))
    is_alone()
    shutil.rmtree(tmp_path / "moved")
    is_alone()
    first.terminate()
    first.communicate(timeout=600)
    assert mindrun(bundle, "--arm", "--ticks", 2).returncode == 0


@pytest.mark.parametrize("closed", ["", "<&- >&- 2>&-"])
def test_the_guardian_that_a_dead_controller_leaves_is_not_driven_beside(
    bundle: Path, tmp_path: Path, closed: str
) -> None:
    """It is stopped, as one that waits for an actuator would be there."""
    day = tmp_path / "day.rec"
    line = f"exec {' '.join(MINDRUN)} {bundle} --arm --record {day} {closed}"
    first = subprocess.Popen(["sh", "-c", line], stderr=subprocess.DEVNULL, text=True)
    until(lambda: recorded(day), first)
    (guardian,) = children(first.pid, "guardian")
    os.kill(guardian, signal.SIGSTOP)
    first.kill()
    first.wait()
    said = mindrun(bundle, "--arm", "--ticks", 2)
    os.kill(guardian, signal.SIGCONT)
    assert said.returncode == 2
    assert f"this robot is held by the guardian of process {first.pid}, which has ended" in said.stderr
    until(lambda: mindrun(bundle, "--arm", "--ticks", 2).returncode == 0)


def wired(name: str, *drivers: object) -> Wiring:
    return Wiring(name, (), tuple(ActuatorWire(f"a{n}", driver) for n, driver in enumerate(drivers)))  # type: ignore[arg-type]


def test_a_device_has_one_driver_whatever_its_robot_is_called() -> None:
    address = 0x77 - os.getpid() % 2  # no test beside this one has it
    tracker = SensorWire("eye", BallTracker(pan=3, address=address, bus=7), 180.0, -180.0)
    with hold_devices(wired("one", Pca9685(0, address=address, bus=7), Pca9685(1, address=address, bus=7))) as held:
        assert len(held) == 2
        for other in (wired("two", Pca9685(5, address=address, bus=7)), Wiring("three", (tracker,), ())):
            with pytest.raises(DrivenError, match=f"the device at /dev/i2c-7 {address:#04x} is driven already"):
                hold_devices(other).__enter__()
        assert claims(Wiring("three", (still(tracker),), ())) == ("robot three",)
    with hold_devices(wired("two", Pca9685(5, address=address, bus=7))):
        pass


def test_what_is_claimed() -> None:
    devices = (GroveMotor(1), GroveMotor(2), Pca9685(0), MockActuator(), SimulatedActuator("/tmp/w", "claw"))
    assert claims(wired("r", *devices)) == ("/dev/i2c-1 0x0f", "/dev/i2c-1 0x40", "/tmp/w claw", "robot r")


def test_robots_of_other_names_and_devices_are_others() -> None:
    with hold_devices(wired(f"{NAME} a", MockActuator())), hold_devices(wired(f"{NAME} b", MockActuator())):
        pass


def test_standard_streams_are_no_place_for_what_is_held() -> None:
    """What the guardian gets as its own input would not be held by it."""
    with hold_devices(wired(f"{NAME} c")) as held:
        assert min(held) > 2


def test_a_forked_process_holds_nothing() -> None:
    reading, writing = os.pipe()
    with hold_devices(wired(f"{NAME} d")):
        child = os.fork()
        if not child:
            os.write(writing, b"here")
            time.sleep(60)
            os._exit(0)
        assert os.read(reading, 9) == b"here"
    with hold_devices(wired(f"{NAME} d")):
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


RETURNS = """
import os
def f(sense, pulse):
    os.fork()
    return 0.9
"""
RAISES = RETURNS.replace("os.fork()", "assert os.fork()")
BY_C = """
import ctypes, sys, time
def f(sense, pulse):
    sys.setswitchinterval(1000)  # or the child waits for ever for a thread that wanted the GIL and is not in it
    time.sleep(0.02)
    ctypes.PyDLL(None).fork()  # PyDLL: it comes back with the GIL
    sys.setswitchinterval(0.005)
    return 0.9
"""
STAYS = """
import os, time
children = []
def f(sense, pulse):
    if not children:
        children.append(os.fork())
        if not children[0]:
            ends = {os.readlink(f"/proc/self/fd/{number}") for number in (1, 2)}
            for number in range(64):  # who reads what mindrun says does not wait for it
                if os.path.lexists(place := f"/proc/self/fd/{number}") and os.readlink(place) in ends:
                    os.close(number)
            time.sleep(30)
            os._exit(0)
    return 0.9
"""


@pytest.mark.parametrize("source", [RETURNS, RAISES, BY_C, STAYS], ids=["returns", "raises", "by C", "stays"])
def test_what_a_procedure_forks_is_no_second_controller(bundle: Path, tmp_path: Path, source: str) -> None:
    write_procedure(bundle, source)
    said = program(bundle, "--arm", "--ticks", 6, "--record", tmp_path / "day.rec")
    assert said.returncode == 0, said.stderr
    assert "a frame" not in said.stderr, "it has latched"
    assert [row["tick"] for rows in read(tmp_path / "day.rec")[1] for row in rows] == list(range(6))
    assert mindrun(bundle, "--arm", "--ticks", 1).returncode == 0, "a child holds the robot"
