"""The ownership of a robot: only a bundle that was built for it moves it, and one process at a time.

`mindrun adopt` writes one line into a file on the robot: its name, and a SHA-256 of its wiring and neutral commands.
The process that drives, and its guardian, hold the names of the robot and its devices while they live. These are
addresses of the kernel (abstract sockets), no files: none can be deleted or moved, they are the same for every user,
and they are free once no process has them any more, however it ended.
"""

import errno
import fcntl
import os
import socket
import struct
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from hashlib import sha256
from pathlib import Path

from mindrun.errors import MindError, reason
from mindrun.files.atomic_write import destination, write
from mindrun.files.regular_files import read_regular
from mindrun.graph.bundle import fingerprint
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import Wiring
from mindrun.robot.processes import let_go_in_children

MAX_IDENTITY_BYTES = 4096  # of what a robot says
PREFIX = b"\0mind "  # an address that begins with a zero is in no folder
FIRST_FREE_DESCRIPTOR = 3  # descriptors below this are standard input, output and error, whether they are there or not
PEER = struct.Struct("3i")  # process, user, group


def identity_file() -> Path:
    """The file that says which wiring this robot has: `MIND_ROBOT`, or one in the user's configuration."""
    if given := os.environ.get("MIND_ROBOT"):
        return Path(given)
    try:
        return Path.home() / ".config" / "mind" / "robot"
    except RuntimeError as error:
        hint = "say in MIND_ROBOT in which file this robot says which it is"
        raise MindError("you have no home folder", hint) from error


def adopt(wiring: Wiring, graph: Graph) -> Path:
    """Write down that this robot is wired so from now on; the file that says it."""
    path = identity_file()
    path.parent.mkdir(parents=True, exist_ok=True)
    write(destination(path), f"{wiring.robot} {identity(wiring, graph)}\n".encode())
    return path


def identity(wiring: Wiring, graph: Graph) -> str:
    """The SHA-256 of a wiring and of the neutral commands that go with it: one wiring's neutral is another's motion."""
    neutrals = ", ".join(f"{actuator.name} {actuator.kind.neutral!r}" for actuator in graph.actuators)
    return sha256(f"{fingerprint(wiring)} {neutrals}".encode()).hexdigest()


def is_adopted(wiring: Wiring, graph: Graph) -> bool:
    """True if this robot has adopted just this wiring; False if it has adopted none, MindError for another."""
    path = identity_file()
    try:
        name, _, known = read_regular(path, MAX_IDENTITY_BYTES).decode().strip().rpartition(" ")
    except FileNotFoundError:
        return False
    except (OSError, UnicodeDecodeError) as error:
        raise MindError(f"{path} cannot be read: {reason(error)}") from error
    if known != identity(wiring, graph):
        raise MindError(
            f"this bundle is for {wiring.robot}, whose wiring or neutral commands are others than those of "
            f"{name or 'this robot'}",
            "build it for this robot; or, where this robot has been wired anew, adopt it: mindrun adopt --help",
        )
    return True


class DrivenError(MindError):
    """Another process drives this robot, or one of its devices."""


@contextmanager
def hold_devices(wiring: Wiring) -> Iterator[tuple[int, ...]]:
    """Descriptors that let no other process drive what is wired, for the guardian too; DrivenError where one does."""
    with ExitStack() as stack:
        yield tuple(stack.enter_context(bound_address(what)) for what in claims(wiring))


def claims(wiring: Wiring) -> tuple[str, ...]:
    """Names of all that only one process may drive: the devices that move something, and the robot."""
    drivers = [*(wire.driver for wire in wiring.actuators), *(wire.driver for wire in wiring.sensors)]
    devices = {getattr(driver, "device", "") for driver in drivers} - {""}
    return (*sorted(devices), f"robot {wiring.robot}")


@contextmanager
def bound_address(what: str) -> Iterator[int]:
    """Hold what has this name; a descriptor that goes on holding it. DrivenError where another process does."""
    address = PREFIX + sha256(what.encode()).hexdigest().encode()
    with socket.socket(socket.AF_UNIX) as listener:
        try:
            listener.bind(address)
            listener.listen()  # so that others are told who it is
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise
            raise _driven(what, _holder(address)) from None
        descriptor = fcntl.fcntl(listener, fcntl.F_DUPFD_CLOEXEC, FIRST_FREE_DESCRIPTOR)

    def close() -> None:
        os.close(descriptor)

    let_go_in_children.add(close)
    try:
        yield descriptor
    finally:
        let_go_in_children.discard(close)
        close()


def _holder(address: bytes) -> int:
    """The process that holds an address, or did when its guardian began; 0 where that cannot be known."""
    with suppress(OSError), socket.socket(socket.AF_UNIX) as caller:
        caller.setblocking(False)
        caller.connect(address)
        return int(PEER.unpack(caller.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, PEER.size))[0])
    return 0


def _driven(what: str, process: int) -> DrivenError:
    which = "this robot" if what.startswith("robot ") else f"the device at {what}"
    if process and not _lives(process):
        return DrivenError(
            f"{which} is held by the guardian of process {process}, which has ended: an actuator is not at neutral yet",
            "cut the actuators' power if that does not change",
        )
    who = f"process {process}" if process else "another process"
    return DrivenError(f"{which} is driven already, by {who}", "end that first: systemctl --user stop mind")


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except OSError as error:
        return error.errno != errno.ESRCH  # it may be another user's
    return True
