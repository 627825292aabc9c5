"""A file that a thread writes: a slow card holds no tick, and an error of it is told."""

import os
from io import BytesIO
from pathlib import Path
from threading import Event
from threading import enumerate as enumerate_threads
from typing import Any

import pytest
from mindrun.robot import recording
from mindrun.robot.recording import About, BackgroundFile, Recorder, RecordingError, TemporaryRecorder, read

from tests.robot.driving import until
from tests.robot.faults import graph


def about() -> About:
    of = graph("bearing")
    return About.of(of, "0" * 64, of.master, ("sense",))


class SlowCard(BytesIO):
    """Takes nothing until it is ready."""

    def __init__(self) -> None:
        super().__init__()
        self.ready = Event()

    def write(self, data: Any) -> int:
        assert self.ready.wait(60)
        return super().write(data)


def test_nobody_waits_for_a_slow_card_until_the_end() -> None:
    card = SlowCard()
    file = BackgroundFile(card)
    rows = [bytes([number]) * 99 for number in range(200)]
    for row in rows:
        file.write(row)
    assert card.getvalue() == b""
    card.ready.set()
    file.flush()
    assert card.getvalue() == b"".join(rows)
    file.close()
    assert card.closed


def test_a_card_that_takes_nothing_any_more_fails_before_memory_is_full(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recording, "MAX_WAITING_BYTES", 1000)
    card = SlowCard()
    file = BackgroundFile(card)
    for _ in range(11):
        file.write(bytes(100))
    with pytest.raises(TimeoutError):
        file.write(bytes(100))
    card.ready.set()
    file.flush()
    file.write(bytes(100))  # it was only slow
    file.close()


def test_a_recording_that_cannot_begin_leaves_nothing_open(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    full = tmp_path / "full"
    full.symlink_to("/dev/full")
    monkeypatch.setattr(Path, "open", lambda path, mode: open(path, "wb"))  # noqa: PTH123, SIM115  "x" refuses it
    before = {thread.name for thread in enumerate_threads()}, len(os.listdir("/proc/self/fd"))  # noqa: PTH208
    with pytest.raises(OSError, match="No space left"):
        Recorder(full, about())
    assert ({thread.name for thread in enumerate_threads()}, len(os.listdir("/proc/self/fd"))) == before  # noqa: PTH208


def test_what_is_recorded_for_a_viewer_alone_is_given_up_where_there_is_no_room(tmp_path: Path) -> None:
    day, told = tmp_path / "day.rec", list[str]()
    with TemporaryRecorder(day, about(), told.append) as recorder:
        recorder.write(tick=0)
        recorder._file.flush()
        full = os.open("/dev/full", os.O_WRONLY)
        os.dup2(full, recorder._file.fileno())
        os.close(full)

        def is_told() -> bool:
            recorder.write(tick=1)
            return bool(told)

        until(is_told)
        for tick in range(2, 20):
            recorder.write(tick=tick)
    assert told == [f"nothing more is seen, and the robot drives on: {day} cannot be written: No space left on device"]
    assert [int(row["tick"]) for rows in read(day)[1] for row in rows] == [0]


def test_each_row_is_seen_without_another_one_after_it(tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    with Recorder(day, about()) as recorder:
        for tick in range(20):
            recorder.write(tick=tick, time=tick / 100)
            until(lambda: sum(map(len, read(day)[1])) == tick + 1)  # noqa: B023  called before the next
    assert [int(row["tick"]) for rows in read(day)[1] for row in rows] == list(range(20))


def test_a_full_disk_is_told_and_nothing_is_written_behind_a_gap(tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    recorder = Recorder(day, about())
    recorder.write(tick=0)
    recorder._file.flush()
    rest, full = os.dup(recorder._file.fileno()), os.open("/dev/full", os.O_WRONLY)
    os.dup2(full, recorder._file.fileno())
    recorder.write(tick=1)
    with pytest.raises(RecordingError, match=r"day\.rec cannot be written: No space left on device"):
        recorder.close()
    os.dup2(rest, full)
    with pytest.raises(RecordingError, match="No space left"):
        recorder.write(tick=2)
    os.close(rest)
    os.close(full)
    assert [int(row["tick"]) for rows in read(day)[1] for row in rows] == [0]


def test_the_loop_hears_that_nothing_is_written_any_more(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "day.rec", about())
    full = os.open("/dev/full", os.O_WRONLY)
    os.dup2(full, recorder._file.fileno())
    os.close(full)
    failed: list[RecordingError] = []

    def fails() -> bool:
        try:
            recorder.write(tick=1)
        except RecordingError as error:
            failed.append(error)
        return bool(failed)

    until(fails)
    with pytest.raises(RecordingError):
        recorder.close()
