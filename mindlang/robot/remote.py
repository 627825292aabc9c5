"""A robot as ssh and rsync reach it: verbs of robot.sh asked of it, folders copied to it."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from threading import Event, Thread
from typing import IO

from mindlang.robot import DeployError

HOST = re.compile(r"(?:[A-Za-z0-9_][\w.-]*@)?[A-Za-z0-9_][\w.-]*", re.ASCII)
SSH_FAILURE_CODE = 255  # ssh's own exit code
SCRIPTS = ("robot.sh", "switch.sh")
HEARTBEAT_SECONDS = 5.0  # after thirty without one the robot is free again
RobotEvent = tuple[str, str]  # an event, and its detail
LOCK_HELD: RobotEvent = ("held", "")
LOCK_WAITING: RobotEvent = ("waiting", "")


def check_host(host: str) -> None:
    """Refuse what ssh or rsync could take for an option, a path, or a command."""
    if not HOST.fullmatch(host):
        raise DeployError(
            f"{host!r} is not a host: write it as pi@robot.local.",
            "A port, an address with colons or a key belong under a Host in ~/.ssh/config.",
        )


def check_tools() -> None:
    """Refuse to begin without the two programs that do the work."""
    for tool, package in (("ssh", "openssh-client"), ("rsync", "rsync")):
        if shutil.which(tool) is None:
            raise DeployError(f"{tool} is not installed here.", f"sudo apt install {package}")


@dataclass(frozen=True, slots=True)
class RemoteRobot:
    """A host, and the options of the one connection that all steps share."""

    host: str
    options: tuple[str, ...]

    def run_verb(self, verb: str, *words: str) -> list[RobotEvent]:
        """Run one verb of robot.sh on the robot; the events that it printed. DeployError where it fails."""
        done = subprocess.run(
            self._shell,
            input=script(verb, words),
            stdout=subprocess.PIPE,  # stderr is the user's: ssh asks and explains there
        )
        told = list(parse_events(done.stdout))
        if done.returncode:
            raise _refusal(self.host, done.returncode, told)
        return told

    @contextmanager
    def locked(self, waits: Callable[[], None]) -> Iterator[None]:
        """Hold the lock of the robot; `waits` is called while another deployment has it. DeployError after a minute."""
        with subprocess.Popen(self._shell, bufsize=0, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            assert process.stdin is not None
            assert process.stdout is not None
            with suppress(BrokenPipeError):  # it has ended, and its exit code says why
                process.stdin.write(script("hold", ()))
            told = []
            for event in (event for line in process.stdout for event in parse_events(line)):
                told.append(event)
                if event == LOCK_HELD:
                    break
                if event == LOCK_WAITING:
                    waits()
            if told[-1:] != [LOCK_HELD]:
                raise _refusal(self.host, process.wait(), told)
            ended = Event()
            beating = Thread(target=_beat, args=(process.stdin, ended), daemon=True)
            beating.start()
            try:
                yield
            finally:
                ended.set()
                beating.join()

    @property
    def _shell(self) -> list[str]:
        """The command that runs a script there; no other word is in it, since the login shell may be any."""
        return ["ssh", *self.options, "--", self.host, "sh -s"]

    def copy(self, folder: Path, to: str) -> None:
        """Make the robot's folder `to`, which is relative to its home, the same as `folder`."""
        shell = " ".join(["ssh", *self.options])  # rsync splits this at spaces: no option has one
        words = ["rsync", "--recursive", "--times", "--chmod=D755,F644", "--delete", "--timeout=60", "--rsh", shell]
        done = subprocess.run([*words, "--", f"{folder}/", f"{self.host}:{to}/"], stdout=subprocess.DEVNULL)
        if done.returncode:
            raise DeployError(
                f"The copy to {self.host} broke off, what is current there stays (rsync ended with {done.returncode}).",
                "The same command goes on where it stopped.",
            )


def _beat(there: IO[bytes], ended: Event) -> None:
    """Let the robot hear now and then that this deployment goes on; the end of its input says that it does not."""
    with suppress(OSError):
        while not ended.wait(HEARTBEAT_SECONDS):
            there.write(b".")


@contextmanager
def connected(host: str) -> Iterator[RemoteRobot]:
    """A robot that asks for a password once at most; the connection ends with the block."""
    folder = tempfile.mkdtemp(prefix="mind-", dir="/tmp")  # a socket's path is short, and rsync wants no space in it
    settings = ["ControlMaster=auto", f"ControlPath={folder}/%C", "ControlPersist=60", "RemoteCommand=none"]
    settings += ["ConnectTimeout=10", "ServerAliveInterval=5", "ServerAliveCountMax=3"]
    options = ("-axT", *(word for setting in settings for word in ("-o", setting)))
    try:
        yield RemoteRobot(host, options)
    finally:
        if os.listdir(folder):  # noqa: PTH208 - a socket, where a connection was made
            subprocess.run(["ssh", *options, "-O", "exit", "--", host], stderr=subprocess.DEVNULL)
        shutil.rmtree(folder, ignore_errors=True)


def script(verb: str, words: Sequence[str]) -> bytes:
    """The robot's script with its last line, which does nothing unless it has arrived whole."""
    call = shlex.join(["main", verb, *words])
    text = "".join((files("mindlang.robot") / name).read_text(encoding="utf-8") for name in SCRIPTS)
    return f"{text}\n{{ {call}; exit; }}\n".encode()


def parse_events(said: bytes) -> Iterator[RobotEvent]:
    """The events that robot.sh printed; a greeting of the login shell is left out."""
    for line in said.decode(errors="replace").splitlines():
        event, tab, detail = line.partition("\t")
        if tab:
            yield event, detail


def _refusal(host: str, code: int, told: Sequence[RobotEvent]) -> DeployError:
    """Why the robot did not do it, with what its service wrote last."""
    last = dict(told)
    if code == SSH_FAILURE_CODE:
        return DeployError(f"{host} cannot be reached.", f"ssh {host} must work; ~/.ssh/config is honoured.")
    if "refused" not in last:
        return DeployError(f"{host} could not do it (its shell ended with {code}).", "What it wrote stands above.")
    log = [f"  {detail}" for event, detail in told if event == "log"]
    reason = "\n".join([f"{host} says: {last['refused']}.", *log])
    if "back" in last:
        return DeployError(f"{reason}\nIt is back with {last['back']}.", "The new release has been left.")
    if "failed" in last:
        return DeployError(reason, "mindc deploy --rollback goes back to the release before.")
    return DeployError(reason, "Nothing has changed there.")
