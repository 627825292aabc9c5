"""Which robot this is: a bundle that was built for another one moves nothing here.

A file of the robot's own says it in one line, which `mindrun adopt` writes: its name, and a SHA-256 of its wiring and
of what its mind takes for neutral.
"""

import os
from hashlib import sha256
from pathlib import Path

from mindrun.errors import MindError, reason
from mindrun.files.atomic_write import destination, write
from mindrun.files.regular_files import read_regular
from mindrun.graph.bundle import fingerprint
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import Wiring

MAX_IDENTITY_BYTES = 4096  # of what a robot says


class IdentityError(MindError):
    """A bundle for another robot, or a robot that has not said which it is."""


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
        name, _, known = read_regular(path, MAX_IDENTITY_BYTES).decode().strip().rpartition(" ")
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
