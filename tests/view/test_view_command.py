"""`mindc view` from its command to its end."""

import asyncio
import errno
import os
import signal
import socket
import subprocess
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Event
from urllib.request import urlopen

import pytest
from websockets.sync.client import connect
from websockets.typing import Origin

from mindlang.cli._options import RunChoice
from mindlang.cli.view import run_view
from mindlang.view.server import ViewServer, open_browser
from mindlang.view.session import ViewSession
from tests.calling import Call
from tests.view.serving import ANSWER_SECONDS, ViewingClient

MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")


@contextmanager
def begun(*words: object) -> Iterator["subprocess.Popen[str]"]:
    """The command as a process, which does not outlive the test."""
    command = [*MINDC, "view", *map(str, words), "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ)
    try:
        with process:
            yield process
    finally:
        process.kill()


def test_it_says_where_it_is_and_ctrl_c_ends_it_quietly(rules: Path) -> None:
    with begun(rules, "--task", "Chase", "--seed", 3) as process:
        assert process.stdout is not None
        address, token = process.stdout.readline().strip().split("#")
        assert address.startswith("http://127.0.0.1:")
        with urlopen(address) as page:
            assert page.headers["Content-Type"] == "text/html; charset=utf-8"
        with connect(f"ws{address.removeprefix('http')}rows", origin=Origin(address.rstrip("/"))) as connection:
            connection.send(token)
            viewer = ViewingClient(connection)
            about = viewer.hear("about")
            assert (about["task"], about["seed"], about["edits"]) == ("Chase", "3", True)
            assert viewer.run(100)["known"] >= 100
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=ANSWER_SECONDS)
    assert process.returncode == 130
    assert (out, err.strip().splitlines()[-1]) == ("", "Ctrl-C ends this; a browser that is closed does not.")


def test_a_port_that_is_taken_is_said(rules: Path, mindc: Call) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        said = mindc("view", rules, "--seed", 3, "--port", port, "--no-browser", "-q")
    assert (said.code, said.out) == (2, "")
    assert said.err.startswith(f"port {port} of this machine cannot be opened: Address already in use\n")
    assert "--port" in said.err


def test_an_error_that_is_no_port_s_says_nothing_about_ports(rules: Path) -> None:
    def unready(address: str) -> None:
        raise OSError(errno.EMFILE, "Too many open files")

    viewed = run_view(str(rules), RunChoice("Chase", 3, None, True), None)
    with pytest.raises(OSError, match="Too many open files"):
        asyncio.run(ViewServer(ViewSession(viewed)).serve(unready))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["x.mind", "--export", "x.html", "--port", 8123], "--port and --no-browser are of a page that is served"),
        (["day.rec", "ball.bundle", "--seed", 3], "are of runs, not of recordings."),
        (["day.rec", "ball.bundle", "--follow", "--master", "Go"], "are of runs, not of recordings."),
        (["day.rec", "ball.bundle", "--follow", "--export", "x.html"], "--export is of what has an end"),
        (["x.mind", "--follow"], "--follow is for a recording and its bundle"),
        ([".", "--export", "x.html"], "--break and --export are of a run or a recording, not of trainings."),
        ([".", "ball.bundle"], "BUNDLE, --task, --master, --robot, --no-interruption, --break and --export are of"),
    ],
)
def test_an_option_of_which_nothing_would_come_is_refused(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[object], said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    found = mindc("view", *words)
    assert (found.code, found.out) == (2, "")
    assert said in found.err
    assert not (tmp_path / "x.html").exists()


@pytest.mark.parametrize("port", [0, -1, 65536, "http"])
def test_what_is_no_port_is_refused(rules: Path, mindc: Call, port: object) -> None:
    assert mindc("view", rules, "--port", port).code == 2


def test_a_bundle_without_a_name_is_no_run(rules: Path, mindc: Call) -> None:
    said = mindc("view", rules, "", "--no-browser")
    assert said.code == 2
    assert f"What stands behind {rules} is empty." in said.err


def test_a_browser_with_windows_is_opened_and_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that runs in a terminal would take the one that the command runs in."""
    opened, done = [], Event()

    class Windows(webbrowser.BaseBrowser):
        def open(self, url: str, new: int = 0, autoraise: bool = True) -> bool:
            opened.append(url)
            done.set()
            return True

    monkeypatch.setattr(webbrowser, "get", Windows)
    open_browser("http://127.0.0.1:1/#token")
    assert done.wait(ANSWER_SECONDS)
    monkeypatch.setattr(webbrowser, "get", lambda: webbrowser.GenericBrowser("true"))
    open_browser("http://127.0.0.1:2/#token")

    def none() -> None:
        raise webbrowser.Error("there is none")

    monkeypatch.setattr(webbrowser, "get", none)
    open_browser("http://127.0.0.1:3/#token")
    assert opened == ["http://127.0.0.1:1/#token"]


def test_what_edges_say_is_told(rules: Path) -> None:
    viewed = run_view(str(rules), RunChoice("Chase", 3, None, True), None)
    texts = {edge["text"] for edge in viewed.about["edges"]}
    assert {"at 1", "at 0.2", "at 3 * ball_bearing - 0.7"} <= texts


def test_breakpoints_of_a_file_stop_the_run(rules: Path, mindc: Call) -> None:
    breaks = rules.with_name("chase.break")
    breaks.write_text("stop on 2 reach of ball\nstop in tick 9\n")
    viewed = run_view(str(rules), RunChoice("Chase", 3, None, True), breaks)
    while not viewed.over:
        viewed.grow()
    reached = [tick for tick, event in viewed.happened if viewed.about["events"][event]["kind"] == "reach"]
    assert viewed.stops == [(9, "line 2: stop in tick 9"), (reached[1], "line 1: stop on 2 reach of ball")]
    breaks.write_text("stop at tick 9\n")
    said = mindc("view", rules, "--task", "Chase", "--break", breaks, "--no-browser")
    assert (said.code, said.out) == (1, "")
    assert "Write stop in tick 9." in said.err
