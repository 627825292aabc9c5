"""The page of a robot that drives: another process reads the recording and serves it, and the robot waits for nothing.

The viewer is `mindc view --follow` of mindlang, where that is installed; it is not imported here. It gives way to
all else, inherits no device and no pipe of the guardian, and is killed when the robot, or what drives it, has ended.
"""

import os
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from threading import Event, Thread

from mindrun.errors import reason
from mindrun.files.printable import visible
from mindrun.robot.ownership import DrivenError, bound_address
from mindrun.terminal.command_line import command_line

PAGE_PORT = 8123  # tried first, so that the tunnel to a robot is the same each time
MAX_LINE_CHARACTERS = 4096
SERVER_ADDRESS = 2  # of the words of SSH_CONNECTION: client, its port, server, its port
VIEWER_NICENESS = 10
END_SECONDS = 1.0  # for a viewer that was killed: one that waits for a disk ends later, by itself
MINDC = "from mindlang.cli import main; main()"
PROGRAM = (
    "import signal, sys; from mindrun.robot.processes import end_with_parent; "
    "from mindrun.processors import give_way; "
    f"end_with_parent(int(sys.argv.pop(1)), signal.SIGKILL); give_way({VIEWER_NICENESS}); {MINDC}"
)
CODE = "-P", "-c"  # -P: a file of the user's folder that is named like a module must not be imported


@contextmanager
def live_view(
    recording: Path, bundle: Path, port: int | None, tell: Callable[[str], None], breaks: Path | None = None
) -> Iterator[None]:
    """Serve a recording, which has begun, as long as this lasts; `tell` gets the address, or why there is none.

    The page pauses where a line of the file `breaks` says.
    """
    if not find_spec("mindlang"):
        tell("mindlang is not installed here, so the page is served elsewhere. On your desk, type:")
        pausing = ("--break", Path(breaks.name)) if breaks else ()
        seen = f"{_host()}:{recording.absolute()}"
        tell(command_line("mindc", "view", seen, Path(bundle.name), "--follow", *pausing))
        yield
        return
    with ExitStack() as stack:
        try:
            viewer = _begin(recording, bundle, port or stack.enter_context(_usual_port()), breaks)
        except OSError as error:
            tell(f"there is no view, and the robot drives on: it cannot be started ({reason(error)})")
        else:
            stack.enter_context(_heard(viewer, tell))
        yield


@contextmanager
def _usual_port() -> Iterator[int | None]:
    """PAGE_PORT, which no other robot takes before its viewer has; None where it is taken."""
    with ExitStack() as stack:
        try:
            stack.enter_context(bound_address(f"port {PAGE_PORT}"))
            with socket.socket() as listener:
                listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                listener.bind(("127.0.0.1", PAGE_PORT))
        except (DrivenError, OSError):
            yield None
        else:
            yield PAGE_PORT


@contextmanager
def _heard(viewer: "subprocess.Popen[str]", tell: Callable[[str], None]) -> Iterator[None]:
    """Listen to a viewer, and end it in the end."""
    ending = Event()
    listening = Thread(target=_listen, args=(viewer, ending, tell), name="live_view", daemon=True)
    listening.start()
    try:
        yield
    finally:
        ending.set()
        viewer.kill()
        with suppress(subprocess.TimeoutExpired):
            viewer.wait(END_SECONDS)


def _begin(recording: Path, bundle: Path, port: int | None, breaks: Path | None) -> "subprocess.Popen[str]":
    """The viewer. It ends with the thread that calls this."""
    words = [sys.executable, *CODE, PROGRAM, str(os.getpid()), "view", "--follow", "--no-browser", "-q"]
    if port:
        words += ["--port", str(port)]
    if breaks:
        words += ["--break", str(breaks)]
    return subprocess.Popen(  # in a session of its own: Ctrl-C is the robot's
        [*words, "--", str(recording.absolute()), str(bundle)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True,
    )  # fmt: skip


def _listen(viewer: "subprocess.Popen[str]", ending: Event, tell: Callable[[str], None]) -> None:
    """Tell the address, and when the viewer has ended before the robot; all else that it says is not the robot's."""
    assert viewer.stdout
    why = ""
    with viewer.stdout as lines:
        while line := lines.readline(MAX_LINE_CHARACTERS):
            if line.startswith("http://"):
                tell(f"seen live at {line.strip()}")
                if "SSH_CONNECTION" in os.environ:
                    port = line.removeprefix("http://127.0.0.1:").partition("/")[0].strip()
                    tell(f"your browser gets there through: ssh -N -L {port}:127.0.0.1:{port} {_host()}")
            elif line.strip() and not line.startswith(" "):  # but hints, and where an exception came from
                why = line.strip()
    code = viewer.wait()
    if not ending.is_set():
        tell(f"the view has ended, and the robot drives on: {visible(why) or f'exit {code}'}")


def _host() -> str:
    """This machine's name for a person elsewhere, USER@HOST: the address they reached by ssh, or the host name."""
    words = os.environ.get("SSH_CONNECTION", "").split()
    is_reached = len(words) > SERVER_ADDRESS and ":" not in words[SERVER_ADDRESS]  # HOST:FILE has no place for IPv6
    user = os.environ.get("USER", "")
    return f"{user}@" * bool(user) + (words[SERVER_ADDRESS] if is_reached else socket.gethostname())


def breakpoint_mistakes(breaks: Path, bundle: Path, task: str | None, master: str | None) -> list[str]:
    """The lines that mindc has to say of a file of breakpoints where something is wrong in it, before a robot starts.

    `task` is that of a dry run. Nothing where mindlang is not installed: then the page is served elsewhere, and the
    file is looked at there.
    """
    if not find_spec("mindlang"):
        return []
    for path, suffix in ((breaks, ".break"), (bundle, ".bundle")):
        if path.suffix != suffix:
            return [f"{path} must end in {suffix}: mindc knows by that what it is"]
    options = [*(("--task", task) if task else ()), *(("--master", master) if master else ())]
    command = [sys.executable, *CODE, MINDC, "check", *options, "--", str(breaks), str(bundle)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    if not done.returncode:
        return []
    return (done.stderr.rstrip() or f"{breaks} cannot be looked at: mindc ended with {done.returncode}").split("\n")
