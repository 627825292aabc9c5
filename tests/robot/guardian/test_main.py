"""In which order the guardian does what, and how it ends: the process below it only notes what it is asked for."""

import os
from collections.abc import Callable, Iterator
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field

import pytest
from mindrun.robot.guardian import __main__ as main
from mindrun.robot.guardian import realtime, watch
from mindrun.robot.guardian.plan import Plan
from mindrun.terminal.standard_streams import LineWriter

from tests.robot.guardian.driven import PATIENCE, PLAN

Say = Callable[[str], None]


@dataclass
class Asked:
    """A process that notes what it is asked, and `fails` at one thing; `wrong` is what each opening finds."""

    wrong: Iterator[list[str]] = field(default_factory=lambda: iter([[]]))
    fails: str = ""
    settles: bool = True
    asked: list[object] = field(default_factory=list)
    wake: int = 7
    at_rest: tuple[str, ...] = ("claw",)

    def _note(self, what: str) -> None:
        self.asked.append(what)
        if what == self.fails:
            self.fails = ""
            raise RuntimeError("out of order")

    def open(self) -> list[str]:
        self._note("open")
        return next(self.wrong)

    def serve(self) -> None:
        self._note("serve")

    def rest(self) -> None:
        self._note("rest")

    def settle(self, seconds: float | None = None) -> bool:
        self._note("settle")
        if seconds is not None:
            self.asked.append(seconds)
        return self.settles

    def close(self) -> None:
        self._note("close")


@dataclass
class Time:
    """A clock that only sleep moves."""

    now: float = 64.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def woken(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The descriptors that signals are to wake."""
    found: list[int] = []
    monkeypatch.setattr(main, "wake_on_signals", found.append)
    return found


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> Time:
    clock = Time()
    monkeypatch.setattr(watch, "monotonic", clock.monotonic)
    monkeypatch.setattr(watch, "sleep", clock.sleep)
    return clock


def guarded(process: Asked, monkeypatch: pytest.MonkeyPatch) -> tuple[int, list[str], list[str]]:
    """The exit code, what was reported and what was said of the state."""
    reports: list[str] = []
    states: list[str] = []
    made: list[object] = []

    def make(*given: object) -> Asked:
        made.extend(given)
        return process

    monkeypatch.setattr(main, "Process", make)
    code = main.guard(PLAN, 5, reports.append, states.append, lambda: process._note("rests"))
    assert made[:2] == [PLAN, 5]
    return code, reports, states


def test_it_is_ready_when_all_is_at_neutral_and_ends_there(monkeypatch: pytest.MonkeyPatch, woken: list[int]) -> None:
    process = Asked()
    assert guarded(process, monkeypatch) == (0, [], ["ready"])
    assert process.asked == ["open", "settle", "serve", "rest", "settle", "rests", "close"]
    assert woken == [7]


def test_what_cannot_be_opened_is_told_and_the_others_are_at_neutral(
    monkeypatch: pytest.MonkeyPatch, woken: list[int]
) -> None:
    process = Asked(wrong=iter([["left is missing", "claw is missing"]]))
    said = "left is missing; claw is missing"
    assert guarded(process, monkeypatch) == (69, [said], [f"failed {said}"])
    assert process.asked == ["open", "rest", "settle", "rests", "close"]


@pytest.mark.parametrize("fails", ["open", "settle", "serve"])
def test_an_error_of_its_own_ends_at_neutral(monkeypatch: pytest.MonkeyPatch, woken: list[int], fails: str) -> None:
    process = Asked(fails=fails)
    code, reports, states = guarded(process, monkeypatch)
    assert (code, reports) == (70, ["broken: RuntimeError out of order"])
    assert states == ["ready"] * (fails == "serve")
    done = ["open", "settle", "serve"][: ["open", "settle", "serve"].index(fails) + 1]
    word = ["rests"] * (fails != "open")  # where it was not even tried to open all, nobody knows
    assert process.asked == [*done, "rest", "settle", *word, "close"]


def brought(process: Asked, seconds: float) -> list[str]:
    """What is reported."""
    reports: list[str] = []
    assert watch.bring_to_neutral(process, reports.append, seconds) == ("claw",)  # type: ignore[arg-type,comparison-overlap]
    return reports


def test_to_neutral_once_waits_as_long_as_it_may(time: Time) -> None:
    process = Asked()
    assert brought(process, 5.0) == []
    assert process.asked == ["open", "settle", 5.0]


def test_what_is_busy_is_opened_when_it_is_free(time: Time) -> None:
    process = Asked(wrong=iter([["busy"], ["busy"], []]))
    assert brought(process, 5.0) == []
    assert process.asked == ["open", "open", "open", "settle", pytest.approx(4.9)]


def test_what_cannot_be_opened_in_time_is_told_and_the_others_are_brought(time: Time) -> None:
    process = Asked(wrong=iter([["left is missing", "claw is missing"]] * 99))
    assert brought(process, 1.0) == ["left is missing", "claw is missing"]
    assert process.asked.count("open") in (21, 22)  # every 0.05 s
    assert process.asked[-2:] == ["settle", watch.RETRY_SECONDS]


def test_what_is_not_at_neutral_in_time_is_told(time: Time) -> None:
    process = Asked(settles=False)
    assert brought(process, 2.0) == ["not everything was at neutral after 2 s"]
    assert process.asked == ["open", "settle", 2.0]


def test_all_that_it_does_it_does_in_real_time_and_what_is_printed_meanwhile_is_no_status(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[object] = []

    def done(status: int, *given: object) -> int:
        os.close(status)
        asked.append(given)
        return 3

    monkeypatch.setattr(main, "set_realtime", lambda: asked.append("real time"))
    monkeypatch.setattr(main, "printing_never_waits", lambda: nullcontext(asked.append("printing")))
    monkeypatch.setattr(main, "_done", done)
    monkeypatch.setattr("sys.argv", ["guardian", "--neutral", "plan.json", "--within", "2.5"])
    monkeypatch.setattr("os._exit", asked.append)
    main.main()
    assert asked == ["real time", "printing", ("plan.json", 2.5), 3]


class LateReader:
    """A pipe that nobody reads: full until what writes to it from a thread is waited for."""

    def __init__(self) -> None:
        self.reading, self.writing = os.pipe()
        self._pipe = os.fstat(self.writing).st_ino  # whatever descriptors become of it
        for descriptor in (self.reading, self.writing):
            os.set_blocking(descriptor, False)
        with suppress(BlockingIOError):
            while True:
                os.write(self.writing, bytes(4096))

    def writer(self, descriptor: int, prefix: str = "") -> LineWriter:
        """What writes to a descriptor from a thread."""
        writer = LineWriter(descriptor, prefix)
        if os.fstat(descriptor).st_ino == self._pipe:
            self._drain, writer.drain = writer.drain, self.drain  # type: ignore[method-assign]
        return writer

    def drain(self, seconds: float) -> bool:
        """Read, at last."""
        self.read()
        return self._drain(PATIENCE)

    def read(self) -> bytes:
        """All that is there."""
        return os.read(self.reading, 1 << 20)


@pytest.fixture
def late(monkeypatch: pytest.MonkeyPatch) -> Iterator[LateReader]:
    """Who reads late what is said, or printed."""
    reader = LateReader()
    for module in (main, realtime):
        monkeypatch.setattr(module, "LineWriter", reader.writer)
    yield reader
    for descriptor in (reader.reading, reader.writing):
        os.close(descriptor)


def test_the_last_word_comes_after_all_that_was_said_before_it(
    monkeypatch: pytest.MonkeyPatch, late: LateReader
) -> None:
    (heard, word), asked = os.pipe(), []

    def guard(_plan: Plan, frames: int, _report: Say, state: Say, rests: Callable[[], None]) -> int:
        os.close(frames)
        state("neutral no frame for two ticks")
        rests()
        return 7

    monkeypatch.setattr(main, "INPUT_DESCRIPTOR", os.dup(heard))
    monkeypatch.setattr(main, "set_realtime", lambda: asked.append("real time"))
    monkeypatch.setattr(main, "guard", guard)
    monkeypatch.setattr(main, "watch", lambda plan, frames, status, work: work(word))
    assert (main._guarded(PLAN, late.writing), asked) == (7, ["real time"])
    assert late.read() == b"neutral no frame for two ticks\nrest\n"
    assert os.read(heard, 4096) == b"rest\n"


def test_what_is_printed_last_is_passed_on_before_it_ends(monkeypatch: pytest.MonkeyPatch, late: LateReader) -> None:
    printed = os.dup(late.writing)
    monkeypatch.setattr(realtime, "ERROR_DESCRIPTOR", late.writing)
    monkeypatch.setattr(realtime, "OUTPUT_DESCRIPTOR", printed)
    monkeypatch.setattr(realtime, "LAST_SECONDS", PATIENCE)
    with realtime.printing_never_waits():
        os.write(printed, b"by a driver\n")
        os.write(late.writing, b"of an error\n")
    assert late.read() == b"by a driver\nof an error\n"
