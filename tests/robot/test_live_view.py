"""`mindrun --view`: a page of a robot that drives, whatever becomes of the page."""

import os
import re
import shlex
import signal
import socket
import subprocess
from contextlib import redirect_stderr, suppress
from http.client import HTTPConnection
from io import StringIO
from pathlib import Path
from threading import Timer

import pytest
from mindrun.cli import driving_parser
from mindrun.files.printable import visible
from mindrun.graph.bundle import Bundle, read_bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot import live_view as live
from mindrun.robot.drive import drive
from mindrun.robot.live_view import breakpoint_mistakes
from mindrun.robot.loop import Loop
from mindrun.robot.recording import read

from mindlang.view.viewed_recording import remote
from tests.robot.driving import MINDRUN, PATIENCE, begun, children, mindrun, until, wiring
from tests.robot.faults import graph

ADDRESS = re.compile(r"seen live at http://127\.0\.0\.1:(\d+)/#\S{43}\n")
VIEWER = "--follow"
VIEWER_PATIENCE = 300.0  # it gives way to all else, so that on a busy machine it takes long to begin
TICKS = 10
MOST_NICENESS = 19  # that the system knows


def viewer_of(process: "subprocess.Popen[str]") -> int:
    """The viewer of one that drives."""
    until(lambda: children(process.pid, VIEWER), process)
    (found,) = children(process.pid, VIEWER)
    return found


def is_gone(pid: int) -> bool:
    """Whether a process has ended; nobody may have asked for how."""
    try:
        return "\nState:\tZ" in Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    except (FileNotFoundError, ProcessLookupError):
        return True


def until_said(process: "subprocess.Popen[str]", pattern: re.Pattern[str]) -> re.Match[str]:
    """What is said like this, as soon as it is. One that does not say it is killed, so that nobody waits for ever."""
    assert process.stderr
    said, ending = "", Timer(VIEWER_PATIENCE, process.kill)
    ending.start()
    try:
        for line in process.stderr:
            said += line
            if found := pattern.search(line):
                return found
            assert "the view has ended" not in line, said
    finally:
        ending.cancel()
    raise AssertionError(f"never said: {pattern.pattern}, but\n{said}")


def until_address(process: "subprocess.Popen[str]") -> int:
    """The port of the page, as soon as it is told."""
    return int(until_said(process, ADDRESS)[1])


def ticks(day: Path) -> list[int]:
    """The ticks of a recording."""
    return [int(row["tick"]) for rows in read(day)[1] for row in rows]


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where files that go away are."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    return folder


def test_a_robot_is_seen_while_it_drives(
    bundle: Path, tmp_path: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Through ssh, at a port that is free; the page pauses where a file says."""
    monkeypatch.setenv("SSH_CONNECTION", "10.0.0.2 50000 10.0.0.7 22")
    monkeypatch.setenv("USER", "pi")
    breaks = tmp_path / "day.break"
    breaks.write_text("stop on stopped\n", encoding="utf-8")
    with suppress(OSError), socket.create_server(("127.0.0.1", live.PAGE_PORT)):  # or somebody has it already
        words = [*MINDRUN, bundle, "--view", "--break", breaks]
        process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
        port = until_address(process)
    assert port != live.PAGE_PORT
    until_said(process, re.compile(f"^your browser gets there through: ssh -N -L {port}:127.0.0.1:{port} pi@10.0.0.7$"))
    assert [path.name for path in temporary.rglob("*.rec")] == ["live.rec"]
    client = HTTPConnection("127.0.0.1", port, timeout=VIEWER_PATIENCE)
    client.request("GET", "/")
    assert client.getresponse().status == 200
    viewer = viewer_of(process)
    command = Path(f"/proc/{viewer}/cmdline").read_bytes().split(b"\0")
    assert command[command.index(b"--break") + 1] == str(breaks).encode()
    own = os.getpriority(os.PRIO_PROCESS, process.pid)
    assert os.getpriority(os.PRIO_PROCESS, viewer) == min(MOST_NICENESS, live.VIEWER_NICENESS + own)
    assert Path(f"/proc/{viewer}/oom_score_adj").read_text(encoding="ascii") == "1000\n"
    # Neither the robot's device nor the guardian's pipes: the guardian hears at once when the controller is dead.
    assert held(process.pid) & held(viewer) == {str(Path(f"/proc/{viewer}/fd/1").readlink())}, "what it says alone"
    process.terminate()
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, is_gone(viewer)) == (0, True), err
    assert "drives on" not in err
    assert list(temporary.iterdir()) == []


def held(pid: int) -> set[str]:
    """The pipes and sockets of a process."""
    found = {str(path.readlink()) for path in Path(f"/proc/{pid}/fd").iterdir()}
    return {name for name in found if name.startswith(("pipe:", "socket:"))}


def test_a_mistake_in_the_file_is_said_before_anything_moves(bundle: Path, tmp_path: Path) -> None:
    breaks, day = tmp_path / "day.break", tmp_path / "day.rec"
    breaks.write_text("stop on stopped\nstop on collision\n", encoding="utf-8")
    done = mindrun(bundle, "--view", "--break", breaks, "--record", day)
    assert done.returncode == 2
    assert f"{breaks}:2:9: error: A robot does not record what happens in the world around it." in done.stderr
    assert "nothing moves" in done.stderr
    assert not day.exists()
    done = mindrun(bundle, "--view", "--break", breaks.rename(tmp_path / "day.txt"), "--record", day)
    assert (done.returncode, "day.txt must end in .break" in done.stderr) == (2, True)


@pytest.mark.parametrize("fault", [signal.SIGSTOP, signal.SIGKILL])
def test_a_viewer_that_hangs_or_dies_is_not_the_robots_concern(bundle: Path, tmp_path: Path, fault: int) -> None:
    day = tmp_path / "day.rec"
    process = begun(bundle, day, "--view", stderr=subprocess.PIPE)
    viewer = viewer_of(process)
    os.kill(viewer, fault)
    before = len(ticks(day))
    until(lambda: len(ticks(day)) >= before + TICKS, process)
    process.terminate()
    _, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, is_gone(viewer)) == (0, True), err
    assert ticks(day) == list(range(len(ticks(day))))
    assert ("the view has ended, and the robot drives on: exit -9" in err) == (fault == signal.SIGKILL)


def test_a_view_that_has_ended_is_said_and_the_robot_drives_on(bundle: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A quiet one says it, too."""
    monkeypatch.setattr(live, "PROGRAM", "import sys; print(*sys.argv)")
    options = driving_parser().parse_args([str(bundle), "--view", "--view-port", "8222", "-q"])
    with redirect_stderr(StringIO()) as said:
        drive(
            read_bundle(bundle), wiring(), options, lambda _: None, watch=lambda _: "has ended" not in said.getvalue()
        )
    assert said.getvalue().startswith("the view has ended, and the robot drives on: -c ")
    assert " --port 8222 " in said.getvalue()


def test_of_robots_that_begin_together_one_has_the_usual_port(monkeypatch: pytest.MonkeyPatch) -> None:
    """The other's viewer takes another, however long this one takes to open it."""
    with socket.create_server(("127.0.0.1", 0)) as somebody:
        port = somebody.getsockname()[1]
        monkeypatch.setattr(live, "PAGE_PORT", port)
        with live._usual_port() as taken:
            assert taken is None
    with live._usual_port() as first, live._usual_port() as second:
        assert (first, second) == (port, None)
    with live._usual_port() as again:
        assert again == port


def test_no_viewer_outlives_a_robot_that_is_killed(bundle: Path, tmp_path: Path) -> None:
    process = begun(bundle, tmp_path / "day.rec", "--view", stderr=subprocess.PIPE)
    viewer, own = viewer_of(process), os.getpriority(os.PRIO_PROCESS, process.pid)
    until(lambda: os.getpriority(os.PRIO_PROCESS, viewer) != own or own == MOST_NICENESS, process)  # it has begun
    os.kill(viewer, signal.SIGSTOP)
    process.kill()
    process.communicate(timeout=PATIENCE)
    until(lambda: is_gone(viewer))


def test_each_tick_can_be_read_before_the_next(bundle: Path, tmp_path: Path) -> None:
    """It is waited for: who writes is a thread, which the robot does not wait for."""
    found, day = read_bundle(bundle), tmp_path / "day.rec"

    def watch(loop: Loop) -> bool:
        until(lambda: loop.ticks == len(ticks(day)))
        return True

    options = driving_parser().parse_args([str(bundle), "--record", str(day), "--ticks", "6"])
    drive(found, wiring(), options, lambda sentence: None, watch=watch)
    assert ticks(day)[-1] == 5


# Where no viewer can be started


def heard(recording: Path, bundle: Path, breaks: Path | None = None) -> list[str]:
    """What is told of a view that ends at once."""
    told: list[str] = []
    with live.live_view(recording, bundle, None, told.append, breaks):
        pass
    return told


@pytest.mark.parametrize(
    ("connection", "host"),
    [
        ("10.0.0.2 50000 10.0.0.7 22", "pi@10.0.0.7"),
        ("fe80::2 50000 fe80::7%wlan0 22", f"pi@{socket.gethostname()}"),
        ("", f"pi@{socket.gethostname()}"),
        ("nonsense", f"pi@{socket.gethostname()}"),
    ],
)
def test_without_mindlang_it_says_what_to_type_elsewhere(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, connection: str, host: str
) -> None:
    monkeypatch.setattr(live, "find_spec", lambda name: None)
    monkeypatch.setenv("SSH_CONNECTION", connection)
    monkeypatch.setenv("USER", "pi")
    day = tmp_path / "a day.rec"
    first, line = heard(day, tmp_path / "releases" / "ball.bundle")
    assert "mindlang is not installed here" in first
    mindc, view, recording, *words = shlex.split(line)
    assert (mindc, view, words) == ("mindc", "view", ["ball.bundle", "--follow"])
    assert remote(recording) == (host, str(day))
    _, line = heard(day, tmp_path / "ball.bundle", tmp_path / "a day.break")
    assert shlex.split(line)[-2:] == ["--break", "a day.break"]


def test_what_cannot_be_started_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sys.executable", str(tmp_path / "none"))
    (said,) = heard(tmp_path / "day.rec", tmp_path / "ball.bundle")
    assert said.startswith("there is no view, and the robot drives on: it cannot be started (")


def test_what_a_viewer_says_last_moves_no_cursor(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(live, "PROGRAM", "print('mind: \\x1b[2Jfrog')")
    told: list[str] = []
    with live.live_view(tmp_path / "day.rec", tmp_path / "ball.bundle", None, told.append):
        until(lambda: told)
    assert told == ["the view has ended, and the robot drives on: " + visible("mind: \x1b[2Jfrog")]
    assert told[0].isprintable()


def test_where_mindc_dies_the_breakpoints_are_not_called_right(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sys.executable", "false")
    said = breakpoint_mistakes(tmp_path / "day.break", tmp_path / "ball.bundle", None, None)
    assert said == [f"{tmp_path / 'day.break'} cannot be looked at: mindc ended with 1"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--view", "--describe"), "--view shows a robot that drives"),
        (("--view", "--json"), "--view shows a robot that drives"),
        (("--view", "--readings", "-"), "--view shows a robot that drives"),
        (("--dry", "--view-port", 80), "--view-port is the port of --view"),
        (("--dry", "--break", "day.break"), "--break pauses the page of --view"),
        (("--view", "--view-port", 0), "0 is not a whole number from 1 to 65535"),
    ],
)
def test_what_shows_no_robot_is_refused(bundle: Path, words: tuple[object, ...], said: str) -> None:
    done = mindrun(bundle, *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert said in done.stderr


def test_without_wiring_there_is_no_robot_to_see(tmp_path: Path) -> None:
    path = tmp_path / "mind.bundle"
    write_bundle(path, Bundle(Policy(graph("bearing"), {}), {}))
    done = mindrun(path, "--view")
    assert done.returncode == 2
    assert "this bundle is wired to no robot" in done.stderr
