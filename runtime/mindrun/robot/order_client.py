"""Orders said to a robot that is driven on this machine, by a datagram to the process that drives it.

The address is one of the kernel's and has the number of the process. An order is a line, `wanted 3`; the answer begins
with DONE or REFUSED, and says what the order is now, or why it was not taken and, in a second line, what to do.
"""

import os
import socket
from contextlib import suppress
from pathlib import Path

from mindrun.errors import MindError, reason

ADDRESS = "\0mind orders "  # and the number of the process
SOCKETS = Path("/proc/net/unix")  # the addresses that are taken, where those that begin with a zero have an @
MAX_ORDER_BYTES = 256
DONE, REFUSED = b"+", b"-"
ANSWER_SECONDS = 1.0


def drivers() -> list[int]:
    """The processes of this user that drive a robot here and take orders."""
    with suppress(OSError):
        sign = f"@{ADDRESS[1:]}"
        taken = {line.rpartition(sign)[2] for line in SOCKETS.read_text().splitlines() if sign in line}
        return sorted(int(number) for number in taken if number.isdigit() and _is_own(number))
    return []


def _is_own(process: str) -> bool:
    with suppress(OSError):
        return os.getuid() in (0, Path("/proc", process).stat().st_uid)
    return False


def say_order(name: str, value: float | str, process: int = 0) -> str:
    """Say an order to the robot that a `process` of this machine drives, or the only one; what it is now, in words.

    MindError where there is none or there are several, or where it refuses, with its reason.
    """
    if not process:
        found = drivers()
        if not found:
            raise MindError("no robot that takes orders is driven here by you", "start it: mindrun NAME.bundle")
        if len(found) > 1:
            numbers = ", ".join(map(str, found))
            raise MindError(f"several robots are driven here, by the processes {numbers}", "say which: --process N")
        [process] = found
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as caller:
            caller.bind("")  # at any address, for the answer
            caller.settimeout(ANSWER_SECONDS)
            caller.connect(f"{ADDRESS}{process}")
            caller.send(f"{name} {value}".encode(errors="replace")[:MAX_ORDER_BYTES])
            answer = caller.recv(1 << 12)
    except TimeoutError:
        raise MindError(f"process {process} has not answered within {ANSWER_SECONDS:g} s") from None
    except OSError as error:
        raise MindError(f"process {process} takes no orders: {reason(error)}") from error
    said = answer[1:].decode(errors="replace")
    if answer[:1] != DONE:
        why, _, hint = said.partition("\n")
        raise MindError(why, hint)
    return said
