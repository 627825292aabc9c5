"""A robot that is a folder: ssh, rsync and systemd are small programs, everything else is what a robot has."""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

HOST = "pi@robot"
FAKES = Path(__file__).with_name("fakes")
STEPS = ("mv", "sync", "sha256sum", "rm", "ln", "cp", "mkdir", "flock")  # what changes something, or allows it


@dataclass(frozen=True)
class FakeRobot:
    """The robot's `home`, what it can be told by files, and what it wrote down."""

    root: Path

    @property
    def mind(self) -> Path:
        """Where the releases are."""
        return self.root / "home" / "mind"

    @property
    def unit(self) -> Path:
        """The service."""
        return self.root / "home" / ".config" / "systemd" / "user" / "mind.service"

    def tell(self, what: str, text: object = "") -> None:
        """Have a fake behave in some way."""
        (self.root / what).write_text(str(text))

    def forget(self, *what: str) -> None:
        """Have the fakes behave again."""
        for name in what:
            (self.root / name).unlink(missing_ok=True)

    def log(self, name: str) -> list[str]:
        """The lines that a fake wrote."""
        path = self.root / name
        return path.read_text().splitlines() if path.exists() else []

    def clean(self) -> None:
        """Remove what killed programs could not remove themselves: the folders of their connections."""
        for folder in set(re.findall(r"ControlPath=(/tmp/mind-\w+)/", "\n".join(self.log("ssh.log")))):
            shutil.rmtree(folder, ignore_errors=True)

    def releases(self) -> list[str]:
        """The names of all releases."""
        return sorted(path.name for path in (self.mind / "releases").iterdir())

    def current(self) -> str:
        """The current release, which must be whole: each file is what SHA256SUMS says, and that what the name says."""
        name = (self.mind / "current").readlink().name
        assert is_whole(self.mind / "releases" / name)
        return name

    def master(self) -> str:
        """Who is in charge in the current release, read with its own mindrun."""
        self.current()
        return str(json.loads((self.mind / "current" / "release.json").read_text())["master"])


def is_whole(folder: Path) -> bool:
    """Whether a release is what its name says."""
    sums = (folder / "SHA256SUMS").read_bytes()
    lines = [line.split("  ", 1) for line in sums.decode().splitlines()]
    fit = all(sha256((folder / name).read_bytes()).hexdigest() == digest for digest, name in lines)
    return fit and len(lines) > 10 and sha256(sums).hexdigest()[:8] == folder.name.partition("-")[2]


def make_robot(root: Path, rsync: bool = False) -> FakeRobot:
    """A robot on which nothing was ever deployed; `rsync` is the real one."""
    for folder in ("bin", "robot", "home"):
        (root / folder).mkdir(parents=True)
    for tool in ("ssh",) if rsync else ("ssh", "rsync"):
        shutil.copy(FAKES / tool, root / "bin" / tool)
    for tool in ("systemctl", "python3"):
        shutil.copy(FAKES / tool, root / "robot" / tool)
    for tool in STEPS:
        shutil.copy(FAKES / "step", root / "robot" / tool)
    for tool in ("loginctl", "journalctl", *(() if rsync else ("rsync",))):
        (root / "robot" / tool).symlink_to("/bin/true")
    (root / "python").write_text(sys.executable)
    (root / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n")
    (root / "tmp").mkdir()
    return FakeRobot(root)


def copy(robot: FakeRobot, to: FakeRobot) -> FakeRobot:
    """Another robot with the same releases."""
    shutil.rmtree(to.root, ignore_errors=True)
    shutil.copytree(robot.root, to.root, symlinks=True)
    return to


def deployed(robot: FakeRobot, bundle: Path) -> int:
    """The exit code of a deployment by a program of its own, which may be that of a kill."""
    process = program(robot, "deploy", bundle, HOST, "--watch", 0)
    process.communicate(timeout=600)
    return process.returncode


def program(robot: FakeRobot, *words: object) -> subprocess.Popen[str]:
    """Mindc as a program at the head of a process group of its own."""
    return subprocess.Popen(
        [sys.executable, "-c", "from mindlang.cli import main; main()", *map(str, words)],
        env={
            **os.environ,
            "FAKE": str(robot.root),
            "TMPDIR": str(robot.root / "tmp"),
            "PATH": f"{robot.root}/bin:{os.environ['PATH']}",
        },
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
