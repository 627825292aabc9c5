"""Of processes that lack the same machine code one compiles it; none waits for ever, whatever becomes of that one."""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from mindrun.sim import cache
from mindrun.sim.cache import exclusive
from mindrun.sim.compiling import compiled, entry
from mindrun.sim.numba_internals import callback_of
from numba import types

HOLDS = """
import sys
from pathlib import Path
from mindrun.sim.cache import exclusive
with exclusive(Path(sys.argv[1])):
    print("has it", flush=True)
    sys.stdin.read()
"""
COMPILES = """
import sys
from pathlib import Path
from mindrun.sim import cache
from mindrun.sim.compiling import entry
cache.folder = lambda: Path(sys.argv[1])
def thrice(x):
    return 3 * x
thrice = entry(thrice)
print("ready", flush=True)
sys.stdin.readline()
print(thrice(14.0), sum(thrice.stats.cache_hits.values()))
"""


@contextmanager
def python(program: str, place: Path) -> Iterator["subprocess.Popen[str]"]:
    """A program that has said its first line; it is told to go on by a line, or by the end of its input."""
    words = [sys.executable, "-c", program, str(place)]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline()
        try:
            yield process
        finally:
            process.kill()


@pytest.fixture
def lock(tmp_path: Path) -> Path:
    return tmp_path / "advance.lock"


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """How often one that waits has asked, by a clock that goes on with each question."""
    asked = [0.0]

    class Clock:
        @staticmethod
        def monotonic() -> float:
            return asked[0]

        @staticmethod
        def sleep(seconds: float) -> None:
            asked[0] += seconds

    monkeypatch.setattr(cache, "time", Clock)
    return asked


def test_who_has_it_goes_on_and_the_next_begins(lock: Path) -> None:
    begun = threading.Event()

    def wait() -> None:
        with exclusive(lock):
            begun.set()

    with python(HOLDS, lock) as other:
        waiting = threading.Thread(target=wait)
        waiting.start()
        assert not begun.wait(0.3)
        other.communicate("")
        waiting.join()
    assert begun.is_set()


def test_one_that_was_killed_keeps_nobody_waiting(lock: Path, asked: list[float]) -> None:
    with python(HOLDS, lock) as other:
        os.kill(other.pid, signal.SIGKILL)
        other.wait()
        with exclusive(lock):
            assert asked == [0]


def test_one_that_never_ends_is_not_waited_for_for_ever(lock: Path, asked: list[float]) -> None:
    with python(HOLDS, lock) as other, exclusive(lock):
        assert asked[0] == pytest.approx(cache.WAIT_SECONDS, abs=2 * cache.ASK_AGAIN_SECONDS)
        assert other.poll() is None


@pytest.mark.parametrize("place", ["gone/advance.lock", "."])
def test_where_nothing_can_be_locked_it_goes_on(tmp_path: Path, asked: list[float], place: str) -> None:
    with exclusive(tmp_path / place):
        assert asked == [0]


def test_what_goes_wrong_inside_is_told_and_the_lock_is_free(lock: Path, asked: list[float]) -> None:
    with pytest.raises(FileNotFoundError), exclusive(lock):
        (lock.parent / "nothing").read_text()
    with python(HOLDS, lock):
        assert asked == [0]


def test_of_many_processes_at_once_one_compiles(tmp_path: Path) -> None:
    with python(COMPILES, tmp_path) as a, python(COMPILES, tmp_path) as b, python(COMPILES, tmp_path) as c:
        for process in (a, b, c):
            assert process.stdin is not None
            process.stdin.write("\n")
            process.stdin.flush()
        said = [process.communicate()[0] for process in (a, b, c)]
    assert sorted(said) == ["42.0 0\n", "42.0 1\n", "42.0 1\n"]


@compiled
def half(x):
    return x / 2


@entry
def halved(x):
    return half(x)


def halved_and_more(x: float) -> float:
    return halved(x) + 1


def locks(place: Path) -> set[str]:
    """Of which functions there were locks."""
    return {path.name.split("-")[0] for path in place.glob("*.lock")}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    return tmp_path


def test_nothing_is_locked_where_it_is_found(place: Path) -> None:
    kept: Callable[..., Any] = entry(halved_and_more)
    assert kept(4.0) == 3
    assert locks(place) == {"test_compile_lock.halved", "test_compile_lock.halved_and_more"}
    for path in place.glob("*.lock"):
        path.unlink()
    assert entry(halved_and_more)(4.0) == 3
    assert locks(place) == set()


def test_functions_for_c_are_compiled_alone_as_well(place: Path) -> None:
    code = cache.MachineCode("callback")
    callback_of(half.py_func, types.float64(types.float64), code)
    assert locks(place) == {"callback"}
