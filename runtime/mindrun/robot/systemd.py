"""What a service says to systemd, its manager."""

import os
import socket
from contextlib import suppress


def notify(state: str) -> None:
    """Tell systemd "READY=1", "WATCHDOG=1" or "STOPPING=1"; nothing happens where it is not the one who started us."""
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address:
        return
    if address.startswith("@"):
        address = f"\0{address[1:]}"
    with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) as manager:
        manager.setblocking(False)
        manager.sendto(state.encode(), address)
