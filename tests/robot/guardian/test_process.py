"""A real guardian, and a real controller that dies, hangs or lies. What and in which order, not how soon: see slow."""

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from mindrun.robot.guardian.client import PROGRAM, Guardian, GuardianError
from mindrun.robot.guardian.plan import to_json

from tests.robot.guardian.driven import LOGGED, PATIENCE, PLAN, TICK
from tests.robot.guardian.scenes import HANGS, KILLS, NEUTRALS, Write, hang, kill, patient, robot, start, writes

ROUNDS = 6
MOVING = (0.9, 0.8, 1.0)


@pytest.fixture
def log(tmp_path: Path) -> Iterator[Path]:
    """Where guardians that this test starts write to."""
    file = tmp_path / "log"
    file.write_text("")
    with patient({"MIND_LOG": str(file)}):
        yield file


@pytest.fixture(autouse=True)
def unhurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine a guardian that lives reads late."""
    monkeypatch.setattr("mindrun.robot.guardian.client.HANG_SECONDS", PATIENCE)


def last(log: Path) -> list[Write]:
    """The last write to each actuator."""
    return [[w for w in writes(log) if w.channel == c and w.value is not None][-1] for c in range(len(NEUTRALS))]


def all_at_rest(log: Path) -> bool:
    """Whether each was told neutral last."""
    return all(write.neutral for write in last(log))


def wait_for(log: Path, *, rest: bool) -> None:
    """Wait until all are at neutral, or one is not."""
    give_up = time.monotonic() + PATIENCE
    while all_at_rest(log) != rest:
        assert time.monotonic() < give_up
        time.sleep(0.005)


def drive(guardian: Guardian, log: Path) -> None:
    """Send until something moves."""
    while all_at_rest(log):
        guardian.send(MOVING, armed=True)
        time.sleep(TICK / 2)


@pytest.mark.parametrize("number", KILLS)
def test_a_controller_that_is_killed_leaves_everything_at_neutral(number: signal.Signals, tmp_path: Path) -> None:
    def once(index: int) -> float | None:
        folder = tmp_path / str(index)
        folder.mkdir()
        return kill(folder, number, random.Random(index))

    with ThreadPoolExecutor(2) as pool:
        assert None not in list(pool.map(once, range(ROUNDS // len(KILLS))))


def test_a_controller_that_hangs_leaves_everything_at_neutral_until_it_goes_on(tmp_path: Path) -> None:
    def some(how: str) -> list[float | None]:
        folder = tmp_path / how
        folder.mkdir()
        with robot(folder) as found:
            return [hang(found, how, random.Random(index)) for index in range(ROUNDS // len(HANGS))]

    with ThreadPoolExecutor(len(HANGS)) as pool:
        assert None not in [time for times in pool.map(some, HANGS) for time in times]


@pytest.mark.parametrize("eager", [False, True])
def test_the_first_write_is_neutral(tmp_path: Path, eager: bool) -> None:
    for _ in range(ROUNDS // 2):
        told = start(tmp_path, eager)
        assert [next(write for write in told if write.channel == c).value for c in range(3)] == list(NEUTRALS)
        moved = [write for write in told if write.value is not None and not write.neutral]
        assert not moved or {w.channel for w in told[: told.index(moved[0])]} == {0, 1, 2}


def test_a_controller_that_closes_ends_it_at_neutral_and_closed(log: Path) -> None:
    with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        drive(guardian, log)
    assert all_at_rest(log)
    assert [write.value for write in writes(log)[-3:]] == [None] * 3
    assert guardian._processes.first.returncode == 0


def test_an_error_in_the_controller_ends_at_neutral(log: Path) -> None:
    def fail() -> None:
        with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
            drive(guardian, log)
            guardian.send([1 / 0], armed=True)

    with pytest.raises(ZeroDivisionError):
        fail()
    assert all_at_rest(log)


@pytest.mark.parametrize("commands", [(float("nan"), 0.5, 0.5), (0.5, 0.5)])
def test_what_no_controller_may_send_latches(log: Path, commands: tuple[float, ...]) -> None:
    def until_latched(guardian: Guardian) -> None:
        guardian.send(commands, armed=True)
        while True:
            guardian.send(MOVING, armed=True)
            time.sleep(TICK)

    with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        drive(guardian, log)
        with pytest.raises(GuardianError, match="a frame") as caught:
            until_latched(guardian)
        assert caught.value.hint
        wait_for(log, rest=True)  # the guardian says that it latches before the actuators' own threads have written


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGQUIT"])
def test_told_to_end_it_ends_at_neutral(log: Path, name: str, capfd: pytest.CaptureFixture[str]) -> None:
    with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        drive(guardian, log)
        os.kill(guardian.pid, signal.Signals[name])
        assert guardian._processes.first.wait(PATIENCE) == 0
        assert all_at_rest(log)
        with pytest.raises(GuardianError, match="it has ended, with every actuator at neutral"):
            guardian.send(MOVING, armed=True)


def test_keys_of_a_terminal_do_nothing(log: Path) -> None:
    with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        for number in (signal.SIGINT, signal.SIGTSTP, signal.SIGUSR1, signal.SIGPIPE):
            os.kill(guardian.pid, number)
        drive(guardian, log)
        assert os.getpgid(guardian.pid) != os.getpgid(0)


@pytest.mark.parametrize("name", ["SIGKILL", "SIGSTOP"])
def test_a_guardian_that_dies_or_stops_is_replaced_by_neutral(log: Path, name: str) -> None:
    def until_noticed(guardian: Guardian) -> None:
        for _ in range(1000):
            guardian.send(MOVING, armed=True)
            time.sleep(TICK / 10)

    with Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        drive(guardian, log)
        os.kill(guardian.pid, signal.Signals[name])
        with pytest.raises(GuardianError, match="is gone: another has brought"):
            until_noticed(guardian)
        assert all_at_rest(log)


def test_a_guardian_that_is_lost_before_the_end_is_replaced_by_neutral_too(log: Path) -> None:
    """No tick is sent any more that would show it."""
    guardian = Guardian(PLAN, PATIENCE, LOGGED)
    drive(guardian, log)
    os.kill(guardian.pid, signal.SIGKILL)
    with pytest.raises(GuardianError, match="is gone: another has brought"):
        guardian.close()
    assert all_at_rest(log)


def test_a_device_that_cannot_be_opened_at_first_is_brought_to_neutral_too(log: Path, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    plan.write_text(to_json(PLAN))
    with patient({"MIND_MANNERS": "fine late fine"}):
        done = subprocess.run([*LOGGED, "--neutral", str(plan), "--within", str(PATIENCE)], capture_output=True)
    assert (done.returncode, done.stdout) == (0, b"")
    assert {(write.channel, write.value) for write in writes(log)} >= {(0, 0.5), (1, 0.5), (2, 1.0)}


def test_what_replaces_a_guardian_is_replaced_too(log: Path) -> None:
    with patient({"MIND_MANNERS": "fine fine fine"}):
        guardian = Guardian(PLAN, PATIENCE, LOGGED)
    drive(guardian, log)
    begin, replace = guardian._processes.start_another, iter((True, True, False))

    def killed() -> "subprocess.Popen[bytes]":
        another = begin()
        if next(replace):
            another.kill()
        return another

    guardian._processes.start_another = killed  # type: ignore[method-assign]
    watcher = guardian._processes.first.pid
    os.kill(watcher, signal.SIGSTOP)  # so that it does nothing before it is killed
    for pid in (guardian.pid, watcher):
        os.kill(pid, signal.SIGKILL)
    with pytest.raises(GuardianError, match="is gone: another has brought"):
        guardian.close()
    assert all_at_rest(log)


@pytest.mark.parametrize("name", ["SIGTERM", "SIGINT"])
def test_what_brings_to_neutral_is_not_ended_before(log: Path, tmp_path: Path, name: str) -> None:
    plan = tmp_path / "plan.json"
    plan.write_text(to_json(PLAN))
    with patient({"MIND_MANNERS": "fine tired fine"}):
        process = subprocess.Popen([*LOGGED, "--neutral", str(plan), "--within", str(PATIENCE)])
    while not {0, 2} <= {write.channel for write in writes(log)}:
        time.sleep(0.005)
    process.send_signal(signal.Signals[name])
    assert process.wait(PATIENCE) == 0
    assert all_at_rest(log)


@pytest.mark.parametrize("manner", ["fails", "exits"])
def test_one_that_fails_keeps_no_other_from_neutral(log: Path, manner: str) -> None:
    def until_latched(guardian: Guardian) -> None:
        while True:
            guardian.send(MOVING, armed=True)
            time.sleep(TICK)

    latched = pytest.raises(GuardianError, match="left_wheel failed, as did 2 before")
    with patient({"MIND_MANNERS": f"{manner} fine fine"}), Guardian(PLAN, PATIENCE, LOGGED) as guardian, latched:
        until_latched(guardian)
    assert all_at_rest(log)


def test_one_that_hangs_keeps_no_other_from_neutral(log: Path) -> None:
    with patient({"MIND_MANNERS": "hangs fine fine"}):
        guardian = Guardian(PLAN, PATIENCE, LOGGED)
    drive(guardian, log)
    guardian._patience = 0.5
    while guardian.state != "neutral" or not all_at_rest(log):
        guardian.send(MOVING, armed=True)
        time.sleep(TICK)
    with pytest.raises(GuardianError, match="not at neutral"):
        guardian.close()
    os.killpg(guardian._processes.first.pid, signal.SIGKILL)


def test_one_that_comes_loose_is_opened_anew_at_neutral_and_drives_on(log: Path) -> None:
    held = set()
    with patient({"MIND_MANNERS": "loose fine fine"}), Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        while None not in (told := [w.value for w in writes(log) if w.channel == 0]) or told[-1] != MOVING[0]:
            guardian.send(MOVING, armed=True)
            held.add(guardian.holds)
            time.sleep(TICK / 2)
        while guardian.holds:
            guardian.send(MOVING, armed=True)
            time.sleep(TICK / 2)
    closed = told.index(None)
    assert told[closed + 1] == 0.5, "the first that is written to what was opened anew is neutral"
    assert held >= {"", "left_wheel failed: no answer"}


def test_one_that_hangs_as_it_is_opened_anew_keeps_no_other_from_neutral(log: Path) -> None:
    with patient({"MIND_MANNERS": "jammed fine fine"}):
        guardian = Guardian(PLAN, PATIENCE, LOGGED)
    while not [write for write in writes(log) if write.value is None]:
        guardian.send(MOVING, armed=True)
        time.sleep(TICK / 2)
    while not all(write.neutral for write in last(log)[1:]):
        time.sleep(0.005)
    guardian.send(MOVING, armed=True)
    assert guardian.state == "neutral"
    guardian._patience = 0.5
    with pytest.raises(GuardianError, match="not at neutral"):
        guardian.close()
    os.killpg(guardian._processes.first.pid, signal.SIGKILL)


def test_what_a_driver_prints_is_no_status(log: Path) -> None:
    with patient({"MIND_PRINTS": ""}), Guardian(PLAN, PATIENCE, LOGGED) as guardian:
        drive(guardian, log)
        assert guardian.state in ("neutral", "following")


def test_neutral_is_repeated_until_it_is_acknowledged(log: Path) -> None:
    with patient({"MIND_MANNERS": "fine tired fine"}), Guardian(PLAN, PATIENCE, LOGGED):
        assert all_at_rest(log)


def test_a_guardian_that_cannot_open_a_device_says_so_and_brings_the_others_to_neutral(log: Path) -> None:
    with patient({"MIND_MANNERS": "fine missing fine"}), pytest.raises(GuardianError, match="right_wheel cannot be"):
        Guardian(PLAN, PATIENCE, LOGGED)
    assert {write.channel for write in writes(log) if write.neutral} == {0, 2}


def test_neutral_that_is_never_acknowledged_is_no_start(log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.robot.guardian.client.WORDS_SECONDS", 0.5)
    with patient({"MIND_MANNERS": "fine stuck fine"}), pytest.raises(GuardianError, match="not ready after 1 s"):
        Guardian(PLAN, patience=1, program=LOGGED)


def test_a_reader_of_its_messages_that_sleeps_does_not_hold_it(log: Path) -> None:
    listening, speaking = os.pipe()
    os.set_blocking(speaking, False)
    while True:
        try:
            os.write(speaking, b"x" * 4096)
        except BlockingIOError:
            break
    os.set_blocking(speaking, True)
    before = os.dup(2)
    os.dup2(speaking, 2)
    try:
        guardian = Guardian(PLAN, PATIENCE, LOGGED)
    finally:
        os.dup2(before, 2)
        os.close(before)
    with guardian:
        drive(guardian, log)
        wait_for(log, rest=True)
    os.close(listening)
    os.close(speaking)


@pytest.mark.parametrize(("manners", "code"), [("fine fine fine", 0), ("fine missing fine", 1), ("stuck fine fine", 1)])
def test_neutral_once(log: Path, tmp_path: Path, manners: str, code: int) -> None:
    plan = tmp_path / "plan.json"
    plan.write_text(to_json(PLAN))
    with patient({"MIND_MANNERS": manners}):
        within = str(PATIENCE) if manners == "fine fine fine" else "0.5"
        done = subprocess.run([*LOGGED, "--neutral", str(plan), "--within", within], capture_output=True)
    assert done.returncode == code
    assert {w.channel for w in writes(log) if w.neutral} == {c for c, m in enumerate(manners.split()) if m == "fine"}


@pytest.mark.parametrize("text", [b"", b"{}\n", b"\xff" * 99])
def test_without_a_plan_it_does_not_start(text: bytes) -> None:
    done = subprocess.run(PROGRAM, input=text, capture_output=True)
    assert done.returncode == 64
    why = done.stderr.removeprefix(b"guardian: ")
    assert done.stdout == b"failed " + why
    assert why.startswith(b"this is no plan of a robot")


def test_it_needs_no_numpy_and_imports_nothing_from_where_it_is_started(tmp_path: Path) -> None:
    (tmp_path / "argparse.py").write_text("raise SystemExit('imported what the user wrote')")
    program = "import sys, mindrun.robot.guardian.__main__, mindrun.kinds.registry as registry\n"
    program += "registry.kinds('actuator driver'); print({'numpy', 'cv2'} & {*sys.modules})"
    done = subprocess.run([sys.executable, *PROGRAM[1:2], "-c", program], capture_output=True, cwd=tmp_path)
    assert (done.stdout, done.stderr) == (b"set()\n", b"")
