"""What the environment says, or does not: each command works, or says in one sentence what it needs."""

import pwd
import subprocess
import sys
from collections.abc import Callable
from itertools import product
from pathlib import Path

import pytest
from mindrun.errors import MindError
from mindrun.robot.ownership import adopt, identity_file
from mindrun.sim import cache
from mindrun.terminal import standard_streams

from tests.calling import Call


def _homeless(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(number: int) -> None:
        raise KeyError(number)

    monkeypatch.delenv("HOME", raising=False)
    monkeypatch.setattr(pwd, "getpwuid", unknown)


def test_a_robot_without_a_home_says_what_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MIND_ROBOT", raising=False)
    _homeless(monkeypatch)
    with pytest.raises(MindError, match="no home folder") as refused:
        identity_file()
    assert "MIND_ROBOT" in refused.value.hint


@pytest.mark.parametrize("place", ["/dev/null", "pipe"])
def test_a_robots_identity_replaces_no_device(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str) -> None:
    import os

    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe")
    monkeypatch.setenv("MIND_ROBOT", place)
    monkeypatch.setattr("mindrun.robot.ownership.identity", lambda wiring, graph: "0" * 64)
    before = Path(place).stat().st_mode

    class Wiring:
        robot = "paper"

    with pytest.raises(OSError, match=r"it is a (device|folder|pipe)"):
        adopt(Wiring(), None)  # type: ignore[arg-type]
    assert Path(place).stat().st_mode == before


def _a_file(path: Path) -> str:
    path.write_text("")
    return str(path)


CACHES: dict[str, Callable[[Path], str]] = {
    "there": lambda path: str(path.mkdir() or path),
    "missing": str,
    "deep": lambda path: str(path / "a" / "b"),
    "a file": _a_file,
    "below a file": lambda path: f"{_a_file(path)}/x",
    "a device": lambda path: "/dev/null",
    "too long": lambda path: str(path / ("x" * 300)),
    "unwritable": lambda path: "/proc/1/nothing",
    "empty": lambda path: "",
    "relative": lambda path: "cache",
}


def test_compiled_code_is_kept_somewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for variable, (kind, make) in product(("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "HOME"), CACHES.items()):
        for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
            monkeypatch.delenv(name, raising=False)
        place = tmp_path / f"{variable} {kind}"
        monkeypatch.setenv("HOME", str(tmp_path / "home"))
        monkeypatch.setenv(variable, make(place))
        folder = cache.folder.__wrapped__()
        assert folder.is_dir()
        assert folder.is_absolute()
        (folder / "kept").write_text("")
        if kind in ("there", "missing", "deep"):
            assert folder.is_relative_to(place)
            assert cache.folder.__wrapped__() == folder


def test_without_a_home_compiled_code_is_kept_for_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    _homeless(monkeypatch)
    assert cache.folder.__wrapped__().is_dir()


LACKS = (
    (MemoryError(), "there is not enough memory for this"),
    (MemoryError("Unable to allocate 5 GiB"), "there is not enough memory for this (Unable to allocate 5 GiB)"),
    (RecursionError("maximum"), "something here is nested too deep"),
    (UnicodeEncodeError("ascii", "é", 0, 1, "no"), "there is text that cannot be read or written in its encoding"),
    (OSError(28, "No space left on device"), "No space left on device"),
    (RuntimeError("can't start new thread"), "the system gives no more threads"),
    (ModuleNotFoundError("No module named 'cv2'", name="cv2"), "something that is needed is not installed"),
)


def test_what_the_machine_lacks_is_no_fault_of_ours(mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MIND_DEBUG", raising=False)
    for raised, said in LACKS:

        def fail(*_: object, raised: Exception = raised) -> None:
            raise raised

        monkeypatch.setattr("mindlang.editing.neighbours.load", fail)
        found = mindc("check", rules)
        assert (found.code, found.out) == (1, "")
        assert found.err.startswith(said)
        assert found.err.count("\n") == 1


def test_a_missing_part_of_ours_is_a_fault_of_ours() -> None:
    from mindrun.errors import surroundings

    assert surroundings(ModuleNotFoundError("no", name="mindlang.x")) == ""
    assert surroundings(ValueError("no")) == ""
    assert standard_streams.output_failure() is None


TALKS = """
import os, sys
from mindrun.terminal.standard_streams import prepare, output_to_standard_error
prepare()
ours = sys.stdout
print("before")
with output_to_standard_error():
    print("Python's")
    os.write(1, b"C's\\n")
    with output_to_standard_error():
        print("ours", file=ours, flush=True)
    print("kept back", file=ours)
print("after")
"""


def test_what_is_printed_around_talk_is_not_its() -> None:
    done = subprocess.run([sys.executable, "-c", TALKS], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("before\nours\nkept back\nafter\n", "Python's\nC's\n")
