"""Of processes that lack the same machine code one compiles it; none waits for ever, whatever becomes of that one."""

import fcntl
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from mindrun.sim import cache, warmup
from mindrun.sim.cache import WAIT_SECONDS, exclusive
from mindrun.sim.compilation import IN_BACKGROUND, compile_missing
from mindrun.sim.units import UNITS

from tests.sim.conftest import Write

HOLDS = """
import sys
from pathlib import Path
from mindrun.sim.cache import exclusive
with exclusive(Path(sys.argv[1]), 0.0):
    print("has it", flush=True)
    sys.stdin.read()
"""
COMPILES = """
import sys
from pathlib import Path
from mindrun.sim import cache, compiling
from mindrun.sim.units import unit
cache.folder = lambda: Path(sys.argv[1])
made, compile_unit = [], compiling.compile_unit
compiling.compile_unit = lambda unit: made.append(unit) or compile_unit(unit)
@unit
def thrice(x: int) -> int:
    return 3 * x
print("ready", flush=True)
sys.stdin.readline()
print(thrice(14), len(made))
"""
TWO = """
@unit
def large(x: int) -> int:
    return 3 * x + x // 2 + 1

@unit
def small(x: int) -> int:
    return x
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


class Clock:
    """In place of `time`: it goes on with each question of one that waits, before which something may happen."""

    now = 0.0
    happens: Callable[[], object] = staticmethod(lambda: None)

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.happens()
        self.now += seconds


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(cache, "time", clock)
    return clock


def test_who_has_it_goes_on_and_the_next_begins(lock: Path, clock: Clock) -> None:
    with python(HOLDS, lock) as other:
        with exclusive(lock, 0.0) as is_alone:
            assert not is_alone
        clock.happens = lambda: other.communicate("")
        with exclusive(lock, WAIT_SECONDS) as is_alone:
            assert is_alone
            assert clock.now == cache.ASK_AGAIN_SECONDS


def test_one_that_was_killed_keeps_nobody_waiting(lock: Path, clock: Clock) -> None:
    with python(HOLDS, lock) as other:
        os.kill(other.pid, signal.SIGKILL)
        other.wait()
        with exclusive(lock, WAIT_SECONDS) as is_alone:
            assert (is_alone, clock.now) == (True, 0)


def test_one_that_never_ends_is_not_waited_for_for_ever(lock: Path, clock: Clock) -> None:
    with python(HOLDS, lock) as other, exclusive(lock, WAIT_SECONDS) as goes_on:
        assert goes_on
        assert clock.now == pytest.approx(WAIT_SECONDS, abs=2 * cache.ASK_AGAIN_SECONDS)
        assert other.poll() is None


@pytest.mark.parametrize("place", ["gone/advance.lock", "."])
def test_where_nothing_can_be_locked_it_goes_on(tmp_path: Path, clock: Clock, place: str) -> None:
    with exclusive(tmp_path / place, 0.0) as goes_on:
        assert (goes_on, clock.now) == (True, 0)


def test_what_goes_wrong_inside_is_told_and_the_lock_is_free(lock: Path) -> None:
    with pytest.raises(FileNotFoundError), exclusive(lock, 0.0):
        (lock.parent / "nothing").read_text()
    with python(HOLDS, lock), exclusive(lock, 0.0) as is_alone:
        assert not is_alone, "the other one has it"


def test_of_many_processes_at_once_one_compiles(tmp_path: Path) -> None:
    with python(COMPILES, tmp_path) as a, python(COMPILES, tmp_path) as b, python(COMPILES, tmp_path) as c:
        for process in (a, b, c):
            assert process.stdin is not None
            process.stdin.write("\n")
            process.stdin.flush()
        said = [process.communicate()[0] for process in (a, b, c)]
    assert sorted(said) == ["42 0\n", "42 0\n", "42 1\n"]


def test_what_another_one_is_at_is_left_to_it_and_made_where_it_fails(
    place: Path, write: Write, made: list[str], clock: Clock
) -> None:
    lanes = write(TWO)
    with python(HOLDS, cache._kept(lanes.large).with_suffix(".lock")) as other:
        clock.happens = lambda: other.communicate("")  # without having made anything
        cache.make_missing([lanes.small, lanes.large])
        assert clock.now > 0
    assert made == ["written.small", "written.large"]
    assert all(map(cache.is_native, (lanes.small, lanes.large)))


def test_nothing_is_locked_where_it_is_found(place: Path, write: Write) -> None:
    for locks in (1, 0):
        assert write(TWO).small(4) == 4
        assert len([*place.glob("*.lock")]) == locks
        for path in place.glob("*.lock"):
            path.unlink()


def test_processes_compile_what_is_missing_and_import_nothing_of_the_working_folder(
    place: Path, made: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (place.parent / "numba.py").write_text("raise SystemExit")  # a procedure of a user may have such a name
    monkeypatch.chdir(place.parent)
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    warmup.every_unit()
    units, told = [UNITS[f"mindrun.sim.lanes.{name}"] for name in ("advance.record", "runs.fill")], list[None]()
    compile_missing(units, lambda: told.append(None))
    assert all(map(cache.is_native, units))
    assert (len(told), made) == (2, [])


def test_what_processes_cannot_compile_is_compiled_here(place: Path, write: Write, made: list[str]) -> None:
    lanes, told = write(TWO), list[None]()
    compile_missing([lanes.small], lambda: told.append(None))
    assert (told, made) == ([], [])
    assert lanes.small(4) == 4
    assert made == ["written.small"]


def test_behind_one_that_compiles_all_nothing_is_begun(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[object] = []
    monkeypatch.setattr(cache, "make_missing", begun.append)
    monkeypatch.setattr(warmup, "give_way", begun.append)
    monkeypatch.setattr(signal, "signal", lambda number, handler: None)
    with (place / "warming").open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        warmup.main([IN_BACKGROUND])
        assert begun == []
    warmup.main([IN_BACKGROUND])
    assert begun == [warmup.LOWEST_NICENESS, warmup.every_unit()]
