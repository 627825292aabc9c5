"""Things that a path can lead to, of every kind."""

import os
import socket
import stat
from collections.abc import Callable
from pathlib import Path

Make = Callable[[Path], None]


def _file(path: Path) -> None:
    path.write_bytes(b"old")


def _socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as listener:
        here = Path.cwd()
        os.chdir(path.parent)  # the name of a socket is short
        listener.bind(path.name)
        os.chdir(here)


def _link_to(make: Make) -> Make:
    def link(path: Path) -> None:
        target = path.with_name("target")
        make(target)
        path.symlink_to(target.name)

    return link


FILES: dict[str, Make] = {
    "nothing": lambda path: None,
    "file": _file,
    "a link to a file": _link_to(_file),
    "a dangling link": lambda path: path.symlink_to("target"),
}
IRREGULAR: dict[str, Make] = {
    "pipe": os.mkfifo,
    "folder": Path.mkdir,
    "socket": _socket,
    "loop": lambda path: path.symlink_to(path.name),
    "a link to a device": lambda path: path.symlink_to("/dev/zero"),
    "a link to a pipe": _link_to(os.mkfifo),
}
KINDS = FILES | IRREGULAR


def look(path: Path) -> tuple[int, str] | None:
    """What stands at a path, and where it leads if it is a link."""
    if not os.path.lexists(path):
        return None
    found = path.lstat()
    return stat.S_IFMT(found.st_mode), str(path.readlink()) if path.is_symlink() else str(found.st_rdev)
