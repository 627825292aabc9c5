"""Doing what a page says, in a folder of its own, as in a terminal of 80 columns."""

import os
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from tests.pages.server import CLIENT
from tests.pages.transcript import Command, Write
from tests.project.sources import ROOT

PROGRAMS = {"mindc": ("-SEc", CLIENT), "mindrun": ("-c", "from mindrun.__main__ import main; main()")}
LONGEST_SECONDS = 1800
OF_COLLECT = {  # pages whose reader is in the folder of examples/collect
    f"docs/{name}.md"
    for name in (
        "breakpoints", "edits", "gymnasium", "lifelong", "lint", "locks", "logs", "proofs", "python", "view", "weights",
        "whatif", "why",
    )
}  # fmt: skip


@dataclass
class Reader:
    """Somebody who has the examples, and follows a page: the folder that is theirs, and the one in which they are."""

    home: Path
    folder: Path

    @classmethod
    def of(cls, page: str, home: Path) -> "Reader":
        """With a copy of the examples and the two programs, in the folder of these that the page speaks of."""
        shutil.copytree(ROOT / "examples", home / "examples", ignore=shutil.ignore_patterns("runs"))
        (home / "bin").mkdir()
        (home / ".config" / "fish" / "completions").mkdir(parents=True)  # as fish makes it when it first runs
        for name, words in PROGRAMS.items():
            program = home / "bin" / name
            program.write_text(f'#!/bin/sh\nexec {shlex.join([sys.executable, *words])} "$@"\n', encoding="utf-8")
            program.chmod(0o755)
        return cls(home, home / "examples" / "collect" if page in OF_COLLECT else home)

    def write(self, step: Write) -> None:
        """Write a file of the page, or change it."""
        path = self.folder / step.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(step.onto(path.read_text(encoding="utf-8") if path.exists() else ""), encoding="utf-8")

    def run(self, command: Command) -> tuple[int, str]:
        """The exit status of a command and all that it printed; `cd` lasts."""
        there = self.home / "bin" / "where"
        words = ["bash", "-c", f"trap 'pwd > {shlex.quote(str(there))}' EXIT\n{command.line}"]
        done = subprocess.run(
            words, cwd=self.folder, env=self._environment(), stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=LONGEST_SECONDS,
        )  # fmt: skip
        self.folder = Path(there.read_text(encoding="utf-8").strip())
        return done.returncode, done.stdout

    def program(self, text: str) -> tuple[int, str]:
        """The exit status of a program in Python and all that it printed."""
        path = self.home / "program.py"
        path.write_text(text, encoding="utf-8")
        return self.run(Command(f"python {shlex.quote(str(path))}", "", 0, 0))

    def _environment(self) -> dict[str, str]:
        path = os.pathsep.join([str(self.home / "bin"), str(Path(sys.executable).parent), os.environ["PATH"]])
        ours = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
        cache = os.environ.get("XDG_CACHE_HOME") or f"{Path.home() / '.cache'}"  # else each page compiles
        theirs = {"HOME": f"{self.home}", "XDG_CACHE_HOME": cache, "PATH": path, "PYTHONPATH": ours}
        return {**os.environ, **theirs, "COLUMNS": "80", "MPLBACKEND": "agg"}
