"""Whatever a path leads to that is to be read: no command waits for it, or reads without end."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from signal import SIGALRM, alarm, signal
from threading import Thread

import pytest
from mindrun.errors import MindError, ProcedureError
from mindrun.files.regular_files import read_regular
from mindrun.kinds.functions.procedure import module_source
from mindrun.robot.guardian.plan import read_plan
from mindrun.robot.recording import read as read_recording

from mindlang.robot.wire import load_wiring
from tests.calling import Call
from tests.surroundings.kinds import IRREGULAR

LONG = 30  # seconds in which anything here is done, on any machine
HUGE = 1 << 40  # bytes of a file with nothing in it


@pytest.fixture(autouse=True)
def _no_waiting() -> Iterator[None]:
    """Nothing here may hang."""

    def late(*_: object) -> None:
        raise TimeoutError("it waits")

    before = signal(SIGALRM, late)
    alarm(LONG)
    yield
    alarm(0)
    signal(SIGALRM, before)


def huge(path: Path) -> None:
    """Make a file as large as can be, which takes no room."""
    path.touch()
    os.truncate(path, HUGE)


READ = {"pipe": IRREGULAR["pipe"], "huge": huge}


@contextmanager
def in_place_of(path: Path, kind: str) -> Iterator[None]:
    path.unlink(missing_ok=True)
    READ[kind](path)
    yield


@pytest.mark.parametrize("kind", IRREGULAR)
def test_only_files_are_read(tmp_path: Path, kind: str) -> None:
    IRREGULAR[kind](tmp_path / "in")
    with pytest.raises(OSError, match=r"it is a (pipe|device|folder|socket)|symbolic links"):
        read_regular(tmp_path / "in", 10)


def test_no_more_is_read_than_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "in"
    path.write_bytes(bytes(range(200)))
    assert read_regular(path, 10) == bytes(range(10))
    assert read_regular(path, 1000) == bytes(range(200))
    huge(path)
    assert len(read_regular(path, 1 << 21)) == 1 << 21


@pytest.mark.parametrize("kind", READ)
def test_a_source(mindc: Call, tmp_path: Path, kind: str) -> None:
    path = tmp_path / "in.mind"
    with in_place_of(path, kind):
        said = mindc("check", path)
    assert said.code == 2
    assert f"{path} " in said.err + said.out
    assert "failed" not in said.err


@pytest.mark.parametrize("kind", READ)
def test_a_used_file(mindc: Call, rules: Path, kind: str) -> None:
    rules.write_text(f'use "in.mind"\n{rules.read_text()}')
    with in_place_of(rules.with_name("in.mind"), kind):
        said = mindc("check", rules)
    assert said.code == 1
    assert "[unreadable-use]" in said.err or "[outside-project]" in said.err


def test_a_neighbour(mindc: Call, rules: Path) -> None:
    alone = mindc("lint", rules)
    with in_place_of(rules.with_name("in.mind"), "pipe"):
        assert mindc("lint", rules) == alone


def test_a_lock(mindc: Call, rules: Path) -> None:
    with in_place_of(rules.with_suffix(".lock"), "pipe"):
        said = mindc("status", rules)
    assert said.code in (1, 2)
    assert "rules.lock" in said.err
    assert "failed" not in said.err


def test_a_robot_yaml_and_a_bundle(mindc: Call, rules: Path) -> None:
    path = rules.with_name("in")
    with in_place_of(path, "pipe"):
        said = mindc("build", rules, "--robot", path, "-o", rules.with_name("out"))
        assert (said.code, rules.with_name("out").exists()) == (2, False)
        assert load_wiring(path, None).readable is False  # type: ignore[arg-type]
        assert mindc("deploy", path, "robot.local").code == 2
        with pytest.raises(MindError):
            read_plan(path)


def test_a_recording_and_a_table(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    with in_place_of(path, "pipe"):
        with pytest.raises(MindError):
            read_recording(path)
        said = mindc("plot", path, "-o", tmp_path / "out.svg")
        assert said.code in (1, 2)
        assert "failed" not in said.err


def test_a_procedure(tmp_path: Path) -> None:
    with in_place_of(tmp_path / "claw.py", "pipe"), pytest.raises(ProcedureError, match="claw"):
        module_source("claw.grip", tmp_path)


def test_a_pipe_that_a_shell_has_opened_is_read(mindc: Call, rules: Path) -> None:
    reading, writing = os.pipe()
    data = rules.read_bytes()
    writer = Thread(target=lambda: (os.write(writing, data), os.close(writing)))
    writer.start()
    said = mindc("check", f"/dev/fd/{reading}")
    writer.join()
    os.close(reading)
    assert said == (0, "", "nothing wrong\n")
