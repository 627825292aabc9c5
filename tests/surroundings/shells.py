"""Real shells in which a line is typed, a tab in it, and what is run is what they have made of it."""

import os
import pty
import select
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

WAIT_SECONDS = 300
READ_SECONDS = 0.1  # of waiting for what a shell says
PROGRAM = """#!/bin/sh
case "$_{upper}_COMPLETE" in "") ;; *) exec {python} -c '{main}' "$@" ;; esac
printf '%s\\n' {name} "$@" > {ran}.tmp
mv {ran}.tmp {ran}
"""
MAIN = {
    "mindc": "from mindlang.cli import main; main()",
    "mindrun": "from mindrun.__main__ import main; main()",
}
START = {
    "bash": ["bash", "--norc", "--noprofile", "-i"],
    "zsh": ["zsh", "-d", "-f", "-i"],
    "fish": ["fish", "--no-config", "--interactive"],
}


def programs(folder: Path, ran: Path) -> Path:
    """A folder of programs that answer shells as ours do, and run nothing: they write down with which words."""
    folder.mkdir()
    for name, main in MAIN.items():
        text = PROGRAM.format(upper=name.upper(), python=sys.executable, main=main, name=name, ran=ran)
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return folder


class Shell:
    """A shell behind a terminal."""

    def __init__(self, descriptor: int, ran: Path) -> None:
        self.descriptor, self.ran, self.seen = descriptor, ran, ""

    def words(self, typed: str) -> list[str]:
        """The words with which a program is run when this is typed, and Enter; AssertionError where none ever is."""
        self.ran.unlink(missing_ok=True)
        os.write(self.descriptor, f"{typed}\n".encode())
        end = time.monotonic() + WAIT_SECONDS
        while not self.ran.exists():
            if select.select([self.descriptor], [], [], READ_SECONDS)[0]:
                self.seen += os.read(self.descriptor, 1 << 16).decode("utf-8", "replace")
            assert time.monotonic() < end, self.seen
        return self.ran.read_text().splitlines()


@contextmanager
def started(name: str, folder: Path, script: Path) -> Iterator[Shell]:
    """A shell in a folder, that has read a script."""
    child, descriptor = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execvp(START[name][0], START[name])
    shell = Shell(descriptor, folder / ".ran")
    try:
        ready = "source" if name != "zsh" else "autoload -Uz compinit; compinit -u -D; source"
        shell.words(f"{ready} {script}; mindrun ready")
        yield shell
    finally:
        os.kill(child, signal.SIGKILL)
        os.close(descriptor)
        os.waitpid(child, 0)
