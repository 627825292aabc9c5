"""Things that a path can lead to, of every kind."""

import os
import socket
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

Make = Callable[[Path], None]


def _file(path: Path) -> None:
    path.write_bytes(b"old")


def _socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as listener:
        here = Path.cwd()
        os.chdir(path.parent)  # the name of a socket is short
        listener.bind(path.name)
        os.chdir(here)


def _node(mode: int, major: int, minor: int) -> Make:
    def make(path: Path) -> None:
        try:
            os.mknod(path, mode | 0o666, os.makedev(major, minor))
        except PermissionError:
            pytest.skip("only root can make a device")

    return make


def _link_to(make: Make) -> Make:
    def link(path: Path) -> None:
        target = path.with_name("target")
        make(target)
        path.symlink_to(target.name)

    return link


DEVICES: dict[str, Make] = {
    "pipe": os.mkfifo,
    "null": _node(stat.S_IFCHR, 1, 3),
    "zero": _node(stat.S_IFCHR, 1, 5),
    "full": _node(stat.S_IFCHR, 1, 7),
    "disk": _node(stat.S_IFBLK, 7, 250),
}
OTHERS: dict[str, Make] = {
    "folder": Path.mkdir,
    "socket": _socket,
    "loop": lambda path: path.symlink_to(path.name),
}
FILES: dict[str, Make] = {
    "nothing": lambda path: None,
    "file": _file,
    "a link to a file": _link_to(_file),
    "a dangling link": lambda path: path.symlink_to("target"),
}
LINKS = {f"a link to a {name}": _link_to(make) for name, make in (DEVICES | OTHERS).items() if name != "loop"}
IRREGULAR = DEVICES | OTHERS | LINKS
KINDS = FILES | IRREGULAR


def look(path: Path) -> tuple[int, str] | None:
    """What stands at a path, and where it leads if it is a link."""
    if not os.path.lexists(path):
        return None
    found = path.lstat()
    return stat.S_IFMT(found.st_mode), str(path.readlink()) if path.is_symlink() else str(found.st_rdev)
