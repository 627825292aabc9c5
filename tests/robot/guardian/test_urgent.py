"""What the guardian asks of the system: all of it, whatever the system refuses."""

import os
import resource
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from mindrun.robot.guardian import realtime

UNLIMITED = resource.RLIM_INFINITY
ASKED = ["stack", "switch", "scheduler", "killed last", "locked", "frozen"]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> dict[str, tuple[Any, ...]]:
    """What is asked for, in its order, and with what; nothing of it happens."""
    found: dict[str, tuple[Any, ...]] = {}

    def note(what: str) -> Callable[..., None]:
        return lambda *given, **named: found.update({what: given})

    monkeypatch.setattr("threading.stack_size", note("stack"))
    monkeypatch.setattr("sys.setswitchinterval", note("switch"))
    monkeypatch.setattr("os.sched_setscheduler", note("scheduler"))
    monkeypatch.setattr(Path, "write_text", note("killed last"))
    monkeypatch.setattr("ctypes.CDLL", lambda *given, **named: SimpleNamespace(mlockall=note("locked")))
    monkeypatch.setattr("gc.freeze", note("frozen"))
    return found


@pytest.mark.parametrize(
    ("user", "limit", "locks"), [(0, 1 << 16, True), (0, UNLIMITED, True), (7, UNLIMITED, True), (7, 1 << 16, False)]
)
def test_memory_is_locked_where_nothing_limits_it(
    asked: dict[str, tuple[Any, ...]], monkeypatch: pytest.MonkeyPatch, user: int, limit: int, locks: bool
) -> None:
    monkeypatch.setattr("os.geteuid", lambda: user)
    # The hard limit is what could be asked for, not what holds.
    monkeypatch.setattr("resource.getrlimit", lambda which: (limit, UNLIMITED))
    realtime.set_realtime()
    assert list(asked) == [what for what in ASKED if what != "locked" or locks]
    assert asked["killed last"][1] == "-1000"
    assert asked["stack"] == (256 << 10,)
    assert asked["switch"][0] < 0.001
    assert asked["scheduler"] == (0, os.SCHED_FIFO, os.sched_param(realtime.FIFO_PRIORITY))
    assert asked.get("locked", (3,)) == (3,)


@pytest.mark.parametrize("what", ["scheduler", "killed last", "locked"])
def test_what_is_refused_keeps_it_from_nothing_else(
    asked: dict[str, tuple[Any, ...]], monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    def refuse(*given: object, **named: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr("os.geteuid", lambda: 0)
    match what:
        case "scheduler":
            monkeypatch.setattr("os.sched_setscheduler", refuse)
        case "killed last":
            monkeypatch.setattr(Path, "write_text", refuse)
        case _:
            monkeypatch.setattr("ctypes.CDLL", lambda *given, **named: SimpleNamespace())  # a system without it
    realtime.set_realtime()
    assert list(asked) == [each for each in ASKED if each != what]
