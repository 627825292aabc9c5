"""The controller's side of the pipe: what it sends, hears and says, to a guardian that does what the test wants."""

import fcntl
import os
import signal
import subprocess
import sys
import time
from array import array
from collections.abc import Callable, Iterator
from pathlib import Path
from termios import FIONREAD
from typing import Any

import pytest
from mindrun.robot import processes
from mindrun.robot.guardian.client import Guardian, GuardianError
from mindrun.robot.guardian.messages import Frame, Reader, size
from mindrun.robot.guardian.plan import from_json

from tests.robot.guardian.driven import PLAN

MOVING = (0.875, 0.25, 1.0)
PATIENCE = 300.0  # seconds for another process to do what it has to; they decide nothing
# What is said at the start, once the plan is read (a part after @ when the controller has begun); what is done then;
# what one says that brings to neutral, or does.
SCRIPT = """
import os, sys, time
log, says, then, ends = sys.argv[1:5]
out = open(log + ("-neutral" if "--neutral" in sys.argv else ""), "ab", buffering=0)
def say(text):
    for part in text.split("|"):
        while part.startswith("@") and not os.path.exists(log + "-begun"):
            time.sleep(0.002)
        sys.stdout.write(part.lstrip("@"))
        sys.stdout.flush()
        time.sleep(0.02)
if "--neutral" in sys.argv:
    out.write(sys.stdin.buffer.read())
    if ends == "killed":
        os.kill(os.getpid(), 9)
    if ends == "hangs":
        time.sleep(20)
    say(ends)
    sys.exit(1)
out.write(sys.stdin.buffer.readline())
say(says)
if then.startswith("exits"):
    sys.exit(int(then.split()[1]))
if then == "sleeps":
    time.sleep(3600)
while data := os.read(0, 65536):
    out.write(data)
if then == "stays":
    time.sleep(3600)
say(then)
"""
RESTS, ALL = "rest\n|over\n", "rest left_wheel\n|rest right_wheel\nrest claw\nover\n"
SOME, NONE = "rest right_wheel\n|over\n", "over\n"
PARTLY = "left_wheel, claw may still move; at neutral: right_wheel"
BROUGHT = {
    ALL: "another has brought the actuators to neutral",
    SOME: PARTLY,
    NONE: "left_wheel, right_wheel, claw may still move; at neutral: none",
    "killed": "left_wheel, right_wheel, claw may still move; at neutral: none",
    "rest claw\n": "left_wheel, right_wheel may still move; at neutral: claw",
    "hangs": "left_wheel, right_wheel, claw may still move; at neutral: none",
}
Start = Callable[..., Guardian]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts one that says `says`, then `sleeps`, `exits CODE`, or reads to the end, and then `stays` or says `then`.

    Another that brings to neutral says `ends`, or is `killed`. All are ended in the end.
    """
    begun: list[Guardian] = []

    def started(says: str = "ready\n", then: str = RESTS, ends: str = ALL, patience: float = PATIENCE) -> Guardian:
        words = (sys.executable, "-c", SCRIPT, str(tmp_path / "log"), says, then, ends)
        begun.append(Guardian(PLAN, patience, words))
        (tmp_path / "log-begun").touch()
        return begun[-1]

    yield started
    for guardian in begun:
        guardian._processes._kill()
        guardian._processes.let_go()


@pytest.fixture(autouse=True)
def unhurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """A guardian of a busy machine has time, unless a test is about just that."""
    monkeypatch.setattr("mindrun.robot.guardian.client.HANG_SECONDS", PATIENCE)
    monkeypatch.setattr("mindrun.robot.guardian.client.WORDS_SECONDS", PATIENCE)


@pytest.fixture
def hurried(monkeypatch: pytest.MonkeyPatch, unhurried: None) -> None:
    """One that has not read at once hangs, and what is not said at once is not said."""
    monkeypatch.setattr("mindrun.robot.guardian.client.HANG_SECONDS", 0.05)


def until(holds: Callable[[], object]) -> None:
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.002)


def heard(guardian: Guardian) -> Guardian:
    """It, when all is heard that it has said."""
    guardian._heard.listen()
    return guardian


def sent(log: Path) -> list[Frame]:
    """The frames after the plan, which is read as well."""
    line, _, frames = log.read_bytes().partition(b"\n")
    assert from_json(line) == PLAN
    return Reader(len(PLAN.channels)).feed(frames)


# What is sent


def test_a_plan_then_frames_that_count_and_a_last_one_that_lets_all_rest(start: Start, tmp_path: Path) -> None:
    before = time.monotonic()
    with start() as guardian:
        assert (guardian.state, guardian.pid) == ("neutral", guardian._processes.first.pid)
        guardian.send(MOVING, armed=True)
        guardian.send(iter(MOVING), armed=False)
    frames = sent(tmp_path / "log")
    assert [(frame.number, frame.armed) for frame in frames] == [(0, True), (1, False), (2, False)]
    assert [frame.commands for frame in frames] == [MOVING, MOVING, (0.5, 0.5, 0.0)]
    assert before < frames[0].sent <= frames[1].sent <= frames[2].sent < time.monotonic()


def test_the_pipe_takes_little_so_that_nothing_waits_long(start: Start, hurried: None) -> None:
    guardian = start(then="sleeps")

    def fill() -> None:
        while True:
            guardian.send(MOVING, armed=True)

    with pytest.raises(GuardianError, match="the guardian hangs: another has brought the actuators to neutral"):
        fill()
    assert guardian._number <= 4096 // size(len(PLAN.channels))


# What is heard


@pytest.mark.parametrize(
    ("says", "then", "why"),
    [
        ("failed left is missing\n", "exits 69", "the guardian cannot start: left is missing"),
        ("failed no\n", RESTS, "the guardian cannot start: no"),
        ("", "exits 0", f"the guardian ended before it was ready; {PARTLY}"),
        ("read", "exits 0", f"the guardian ended before it was ready; {PARTLY}"),
        ("ready\nrest right_wheel\nover\n", "exits 0", f"the guardian ended before it was ready; {PARTLY}"),
    ],
)
def test_one_that_is_not_ready_is_no_guardian(start: Start, says: str, then: str, why: str) -> None:
    with pytest.raises(GuardianError) as caught:
        start(says, then, SOME)
    assert str(caught.value) == why


@pytest.mark.parametrize("then", ["sleeps", "stays"])
def test_one_that_is_never_ready_is_made_to_end(start: Start, monkeypatch: pytest.MonkeyPatch, then: str) -> None:
    begun: list[subprocess.Popen[bytes]] = []

    def begin(*given: Any, **named: Any) -> "subprocess.Popen[bytes]":
        begun.append(popen(*given, **named))
        return begun[-1]

    before, popen = set(processes.let_go_in_children), subprocess.Popen
    monkeypatch.setattr(subprocess, "Popen", begin)
    with pytest.raises(GuardianError) as caught:
        start("starting", then, patience=0.3)
    assert str(caught.value) == f"the guardian is not ready after 0.3 s; {BROUGHT[ALL]}"
    assert processes.let_go_in_children == before
    assert [process.wait(PATIENCE) for process in begun] == [-signal.SIGKILL, 1]


def test_what_comes_in_pieces_is_one_word(start: Start) -> None:
    with start("re|ady|\n|@foll|owing\n") as guardian:
        until(lambda: heard(guardian).state == "following")
        assert guardian.why == ""


def test_of_all_that_was_said_the_last_holds(start: Start) -> None:
    with start("ready\n|@following\nneutral no frame for two ticks\nla", f"\n{RESTS}") as guardian:
        until(lambda: heard(guardian).why != "started")
        assert (guardian.state, guardian.why) == ("neutral", "no frame for two ticks")


def test_a_latched_one_takes_no_frame(start: Start, tmp_path: Path) -> None:
    with start("ready\n|@latched a frame that is damaged\n") as guardian:
        until(lambda: heard(guardian).state == "latched")
        with pytest.raises(GuardianError, match="holds every actuator at neutral: a frame that is damaged") as caught:
            guardian.send(MOVING, armed=True)
        assert caught.value.hint == "start the robot again"
    assert sent(tmp_path / "log") == []


def test_all_that_was_said_is_heard_before_the_next_frame(start: Start) -> None:
    """Half of it would be a frame for a guardian that has latched, and the reason a tick later."""
    said = "following\n" * 9 + "latched a frame that is damaged\n"
    with start(f"ready\n|@{said}") as guardian:
        until(lambda: waiting(guardian) == len(said))
        with pytest.raises(GuardianError, match="a frame that is damaged"):
            guardian.send(MOVING, armed=True)


def waiting(guardian: Guardian) -> int:
    """How many bytes that it has said wait to be heard."""
    found = array("i", [0])
    fcntl.ioctl(guardian._processes.output, FIONREAD, found)
    return found[0]


def test_a_process_that_a_procedure_has_forked_is_no_controller(start: Start, tmp_path: Path) -> None:
    with start() as guardian:
        for call in (lambda: guardian.send(MOVING, armed=True), guardian.close):
            child = os.fork()
            if child == 0:
                try:
                    call()
                finally:
                    os._exit(1)
            assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 70
        guardian.send(MOVING, armed=True)
    assert [frame.number for frame in sent(tmp_path / "log")] == [0, 1]


# How it ends


@pytest.mark.parametrize("code", [0, 70])
def test_one_that_has_said_that_all_rests_is_not_replaced(start: Start, tmp_path: Path, code: int) -> None:
    guardian = start(says="ready\n|@rest\n", then=f"exits {code}")
    assert guardian._processes.first.wait(PATIENCE) == code
    with pytest.raises(GuardianError) as caught:
        guardian.send(MOVING, armed=True)
    assert str(caught.value) == "the guardian is gone: it has ended, with every actuator at neutral"
    guardian.close()
    assert guardian._processes.let_go not in processes.let_go_in_children
    assert not (tmp_path / "log-neutral").exists()


@pytest.mark.parametrize(("code", "sends"), [(0, False), (70, True)])
def test_an_exit_code_says_nothing(start: Start, tmp_path: Path, code: int, sends: bool) -> None:
    """A driver, or a C library below it, may have ended the process with any."""
    guardian = start(then=f"exits {code}")
    assert guardian._processes.first.wait(PATIENCE) == code
    with pytest.raises(GuardianError) as caught:
        guardian.send(MOVING, armed=True) if sends else guardian.close()
    assert str(caught.value) == f"the guardian is gone: {BROUGHT[ALL]}"
    assert (tmp_path / "log-neutral").read_bytes() == guardian._processes.plan


@pytest.mark.parametrize("says", [ALL, SOME, NONE])
def test_what_its_own_watcher_says_is_enough(start: Start, tmp_path: Path, says: str) -> None:
    guardian = start(says=f"ready\n|@{says}", then="stays")
    until(lambda: heard(guardian)._heard.is_over)
    with pytest.raises(GuardianError) as caught:
        guardian.send(MOVING, armed=True)
    assert str(caught.value) == f"the guardian is gone: {BROUGHT[says]}"
    assert not (tmp_path / "log-neutral").exists()


def test_one_that_does_not_end_goes_on_alone(start: Start, tmp_path: Path) -> None:
    guardian = start(then="stays", patience=0.3)
    with pytest.raises(GuardianError) as caught:
        guardian.close()
    assert str(caught.value) == f"an actuator is not at neutral after 0.3 s; process {guardian.pid} goes on trying"
    assert caught.value.hint == "cut the actuators' power"
    assert guardian._processes.first.poll() is None
    assert guardian._processes.let_go not in processes.let_go_in_children


@pytest.mark.parametrize("ends", BROUGHT)
def test_what_came_of_replacing_it_is_told_and_not_tried_again(
    start: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ends: str
) -> None:
    guardian = start(ends=ends)
    guardian._processes.first.kill()
    guardian._processes.first.wait()
    if ends == "hangs":
        monkeypatch.setattr("mindrun.robot.guardian.client.WORDS_SECONDS", 0.0)
    with pytest.raises(GuardianError) as caught:
        guardian.send(MOVING, armed=True)
    assert str(caught.value) == f"the guardian is gone: {BROUGHT[ends]}"
    assert caught.value.hint == ("" if ends == ALL else "cut the actuators' power")
    if ends != "hangs":
        tries = 1 if "over" in ends else 3
        assert (tmp_path / "log-neutral").read_bytes() == guardian._processes.plan * tries
    guardian.close()


@pytest.mark.parametrize("ends", [ALL, SOME])
def test_an_end_without_an_error_is_told_as_it_is_and_one_with_an_error_after_it(start: Start, ends: str) -> None:
    gone = f"the guardian is gone: {BROUGHT[ends]}"

    def lost(error: Exception | None) -> None:
        with start(ends=ends) as guardian:
            guardian._processes.first.kill()
            guardian._processes.first.wait()
            if error:
                raise error

    with pytest.raises(GuardianError) as caught:
        lost(None)
    assert str(caught.value) == gone
    first = ValueError("a procedure failed")
    with pytest.raises(GuardianError) as caught:
        lost(first)
    assert str(caught.value) == f"a procedure failed; {gone}"
    assert caught.value.__cause__ is first


def test_one_that_does_not_read_hangs_and_is_killed(start: Start, tmp_path: Path, hurried: None) -> None:
    guardian = start(then="sleeps")
    with pytest.raises(GuardianError, match="the guardian hangs: another has brought the actuators to neutral"):
        guardian.close()
    assert guardian._processes.first.returncode == -signal.SIGKILL
    assert (tmp_path / "log-neutral").read_bytes() == guardian._processes.plan


def test_what_it_inherits_goes_to_both(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    program = (sys.executable, "-c", SCRIPT, str(tmp_path / "log"), "ready\n", RESTS, ALL)
    with Guardian(PLAN, program=program, inherited=(writing,)) as guardian:
        there, here = (Path(f"/proc/{pid}/fd/{writing}").readlink() for pid in (guardian.pid, os.getpid()))
        assert there == here
        assert not Path(f"/proc/{guardian.pid}/fd/{reading}").exists()
        assert os.getsid(guardian.pid) == guardian.pid
    os.close(reading)
    os.close(writing)
