"""Which robot this is: a bundle that was built for another one moves nothing here, and two never drive it at once.

A file of the robot's own says it in one line, which `mindrun adopt` writes: its name, and a SHA-256 of its wiring and
of what its mind takes for neutral.
"""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from mindrun.bundle import fingerprint
from mindrun.durable import destination, write
from mindrun.errors import MindError, reason
from mindrun.graph import Graph
from mindrun.regular import read_regular
from mindrun.robot.wiring import Wiring

LONGEST = 4096  # bytes of what a robot says


class IdentityError(MindError):
    """A bundle for another robot, a robot that has not said which it is, or one that is driven already."""


def identity_file() -> Path:
    """Where the robot says it: `MIND_ROBOT`, or in the user's configuration."""
    if given := os.environ.get("MIND_ROBOT"):
        return Path(given)
    try:
        return Path.home() / ".config" / "mind" / "robot"
    except RuntimeError as error:
        hint = "say in MIND_ROBOT in which file this robot says which it is"
        raise IdentityError("you have no home folder", hint) from error


def adopt(wiring: Wiring, graph: Graph) -> Path:
    """This robot is wired so from now on; the file that says it."""
    path = identity_file()
    path.parent.mkdir(parents=True, exist_ok=True)
    write(destination(path), f"{wiring.robot} {identity(wiring, graph)}\n".encode())
    return path


def identity(wiring: Wiring, graph: Graph) -> str:
    """The SHA-256 of a wiring and of the neutral commands that go with it: one wiring's neutral is another's motion."""
    neutrals = ", ".join(f"{actuator.name} {actuator.kind.neutral!r}" for actuator in graph.actuators)
    return sha256(f"{fingerprint(wiring)} {neutrals}".encode()).hexdigest()


def is_adopted(wiring: Wiring, graph: Graph) -> bool:
    """Whether this robot has adopted just this wiring; False where it has adopted none, IdentityError for another."""
    path = identity_file()
    try:
        name, _, known = read_regular(path, LONGEST).decode().strip().rpartition(" ")
    except FileNotFoundError:
        return False
    except (OSError, UnicodeDecodeError) as error:
        raise IdentityError(f"{path} cannot be read: {reason(error)}") from error
    if known != identity(wiring, graph):
        raise IdentityError(
            f"this bundle is for {wiring.robot}, whose wiring or neutral commands are others than those of "
            f"{name or 'this robot'}",
            "build it for this robot; or, where this robot has been wired anew, adopt it: mindrun adopt --help",
        )
    return True


@contextmanager
def alone_on_robot() -> Iterator[int]:
    """Let one controller drive this robot: a descriptor that its guardian holds as well, for as long as it lives."""
    path = identity_file().with_name("running")
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            who = os.read(descriptor, 20).decode(errors="replace").strip()
            raise IdentityError(
                f"this robot is driven already, by process {who}", "end that first: systemctl --user stop mind"
            ) from None
        os.ftruncate(descriptor, 0)
        os.pwrite(descriptor, f"{os.getpid()}\n".encode(), 0)
        yield descriptor
    finally:
        os.close(descriptor)
