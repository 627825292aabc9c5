"""One mutant tried: its text in a copy of the sources, and the tests in a process of its own."""

import os
import shutil
import signal
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic, sleep

import pytest

from benchmarks.mutation.mutants import Mutant

COPIED = ("benchmarks", "docs", "editors", "examples", "grammar", "mindlang", "runtime", "tests", "pyproject.toml",
    "README.md", "Makefile", "LICENSE")  # fmt: skip
POLL_SECONDS = 0.05  # seconds between two looks at whether a process has ended
PASSED_CODE, BROKEN_CODE = 0, 70  # exit codes
OPTIONS = (
    "-x",
    "-q",
    "-p",
    "no:cacheprovider",
    "-p",
    "no:xdist",
    "-o",
    "addopts=-m 'not slow'",
    "--hypothesis-seed=0",
    "-W",
    "ignore::pytest.PytestAssertRewriteWarning",
)  # of Hypothesis, which has been imported


@contextmanager
def workshop(root: Path) -> Iterator[Path]:
    """A copy of the sources in which they can be broken."""
    with TemporaryDirectory(prefix="mutation-") as name:
        folder = Path(name).resolve()
        for part in COPIED:
            source = root / part
            if source.is_dir():
                shutil.copytree(source, folder / part, ignore=shutil.ignore_patterns("__pycache__", "runs", "*.mp4"))
            elif source.exists():
                shutil.copy2(source, folder / part)
        yield folder


def survives(folder: Path, mutant: Mutant, tests: tuple[str, ...], interpreted: bool, seconds: float) -> bool:
    """Whether the tests pass with a mutant in place of its file."""
    path = folder / mutant.path
    kept = path.read_bytes()
    path.write_text(mutant.text, encoding="utf-8")
    try:
        return run_tests(folder, tests, interpreted, seconds) == PASSED_CODE
    finally:
        path.write_bytes(kept)


def run_tests(folder: Path, tests: tuple[str, ...], interpreted: bool, seconds: float) -> int | None:
    """The exit code of pytest, which stops at the first failure; None where it took too long, or was killed.

    The process is forked from this one, which has imported what is slow to import and none of what is tried.
    """
    child = os.fork()
    if child == 0:
        os.setsid()
        _become_pytest(folder, tests, interpreted)
    end = monotonic() + seconds
    status = None
    while status is None and monotonic() < end:
        done, code = os.waitpid(child, os.WNOHANG)
        status = code if done else None
        sleep(POLL_SECONDS)
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)  # whatever it has started goes with it
    if status is None:
        os.waitpid(child, 0)
        return None
    return os.waitstatus_to_exitcode(status)


def _become_pytest(folder: Path, tests: tuple[str, ...], interpreted: bool) -> None:
    code = BROKEN_CODE
    try:
        output = os.open(folder / "output.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        for stream, other in ((0, os.open(os.devnull, os.O_RDONLY)), (1, output), (2, output)):
            os.dup2(other, stream)
        os.chdir(folder)
        ours = [str(folder), str(folder / "runtime"), str(Path(__file__).parent)]  # the last has the plugins
        sys.path[:0] = ours
        os.environ["PYTHONPATH"] = os.pathsep.join(ours)
        sys.dont_write_bytecode = True  # a stale one could stand for a mutant
        os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
        plugins = ["-p", "hasty", *(["-p", "interpreted"] if interpreted else [])]
        code = int(pytest.main([*plugins, *OPTIONS, *tests]))
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
