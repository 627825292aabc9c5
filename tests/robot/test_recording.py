"""What is recorded is computed again, bit for bit; what is damaged or foreign is refused."""

import json
import os
from pathlib import Path
from threading import Event, current_thread

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.cli.report import report
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import CHECKSUM_FIELD, _sealed, by_guardian
from mindrun.graph.wiring import SensorWire
from mindrun.robot.drive import _summary
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.recording import About, Recorder, RecordingError, read
from mindrun.robot.replay import replay
from mindrun.robot.sensing import ReadingFilter, Sampler

from tests.minds import always, mind, rule
from tests.robot.faults import TICK, Clock, Scripted, Sent, bus_error, good, graph, robot

BUNDLE = "ab" * 32
TICKS = 300


@pytest.fixture
def day(tmp_path: Path, recorded: bytes) -> Path:
    """A day of noise, of nothing there and of failures."""
    (tmp_path / "day.rec").write_bytes(recorded)
    return tmp_path / "day.rec"


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The recording of that day."""
    path, of, clock = tmp_path_factory.mktemp("recorded") / "day.rec", graph("range_finder"), Clock()
    rng = np.random.default_rng(1)
    script = [
        bus_error if n % 40 == 39 else [None if value > 0.9 else float(value) for value in rng.random(3)]
        for n in range(TICKS)
    ]
    sampler = Sampler(SensorWire("sense", Scripted(3, script), 0.0, 1.0, max_age=2 * TICK), clock)
    with Recorder(path, About.of(of, BUNDLE, of.master, ("sense",))) as recorder:
        loop = Loop(
            ChangedEngine(Policy(of, {})),
            ReadingFilter(of, [sampler]),
            Sent(),
            Rate(TICK, clock, clock.sleep),
            True,
            recorder,
        )
        loop.pace.begin()
        device = None
        for _ in range(TICKS):
            device, sampler.latest = sampler._measured(device)
            loop.tick()
    return path.read_bytes()


def test_a_recording_says_what_happened(day: Path) -> None:
    about, parts = read(day)
    rows = np.concatenate(list(parts))
    assert (about.sensors, about.actuators) == (("sense",), ("left_wheel", "right_wheel", "claw"))
    np.testing.assert_array_equal(rows["tick"], np.arange(TICKS))
    assert rows["stopped"].sum() == (rows["faults"] > 0).sum() == TICKS // 40
    assert (rows["sent"][rows["stopped"] == 1] == [0.5, 0.5, 0]).all()
    np.testing.assert_allclose(np.diff(rows["time"]), TICK)


def test_what_is_not_wired_is_no_number(tmp_path: Path) -> None:
    path, of, clock = (
        tmp_path / "day.rec",
        mind(rule("Go", always("actuator", 0, 0.5), reads=(0,)), readings=2),
        Clock(),
    )
    sampler = Sampler(SensorWire("r0", Scripted(1, [[0.25]]), 0.0, 1.0), clock)
    sampler.latest = sampler.measured_once()
    with Recorder(path, About.of(of, BUNDLE, of.master, ("r0",))) as recorder:
        pace = Rate(TICK, clock, clock.sleep)
        loop = Loop(ChangedEngine(Policy(of, {})), ReadingFilter(of, [sampler]), Sent(), pace, True, recorder)
        loop.pace.begin()
        loop.tick()
    _, parts = read(path)
    assert np.array_equal(np.concatenate([*parts])["readings"], [[0.25, np.nan]], equal_nan=True)
    assert replay(path, BUNDLE, ChangedEngine(Policy(of, {}))).differs is None


def test_it_is_computed_again_bit_for_bit(day: Path) -> None:
    found = replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))
    assert (found.ticks, found.differs) == (TICKS, None)


def test_a_recording_that_says_its_first_tick_again_was_begun_anew_there(day: Path) -> None:
    data = day.read_bytes()
    day.write_bytes(data + data[data.index(b"\n") + 1 :])
    found = replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))
    assert (found.ticks, found.differs) == (2 * TICKS, None)


def test_the_first_tick_that_differs_is_said(day: Path) -> None:
    about, _ = read(day)
    data = bytearray(day.read_bytes())
    offset = data.index(b"\n") + 1 + 120 * about.row.itemsize
    row = np.frombuffer(bytes(data[offset : offset + about.row.itemsize]), about.row).copy()
    row["commands"][0, 1] = np.nextafter(row["commands"][0, 1], np.float32(2))
    data[offset : offset + about.row.itemsize] = resealed(row)
    day.write_bytes(data)
    found = replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))
    assert found.ticks == 120
    assert found.differs
    assert found.differs[0] == 120
    assert found.differs[1] == "right_wheel is 0.899999976 and was 0.900000036"


def test_influence_that_differs_is_said_where_the_commands_do_not(day: Path) -> None:
    about, _ = read(day)
    data = bytearray(day.read_bytes())
    offset = data.index(b"\n") + 1 + 7 * about.row.itemsize
    row = np.frombuffer(bytes(data[offset : offset + about.row.itemsize]), about.row).copy()
    row["influence"][0, 0] = 0.5
    data[offset : offset + about.row.itemsize] = resealed(row)
    day.write_bytes(data)
    found = replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))
    assert (found.ticks, found.differs) == (7, (7, f"{about.skills[0]} is 1 and was 0.5"))


def test_a_recording_without_a_tick_proves_nothing(day: Path) -> None:
    data = day.read_bytes()
    day.write_bytes(data[: data.index(b"\n") + 1])
    with pytest.raises(RecordingError, match="has no tick in it"):
        replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))


def resealed(row: np.ndarray) -> bytes:
    """The row with a checksum that fits."""
    import zlib

    row["check"] = 0
    row["check"] = zlib.crc32(row.tobytes())
    return row.tobytes()


def saying(line: bytes, **said: object) -> bytes:
    """The first line where it says something else, with the checksum that fits."""
    plain = json.loads(line) | said
    del plain["check"]
    return _sealed(json.dumps(plain).encode()[:-1] + CHECKSUM_FIELD)


def test_another_bundle_is_refused(day: Path) -> None:
    with pytest.raises(RecordingError, match="another bundle"):
        replay(day, "cd" * 32, ChangedEngine(Policy(graph("range_finder"), {})))


@pytest.mark.parametrize("share", [0.01, 0.5, 0.99])
def test_a_row_that_was_cut_off_is_no_row(day: Path, share: float) -> None:
    day.write_bytes(day.read_bytes()[: -max(1, int(share * read(day)[0].row.itemsize))])
    assert replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {}))).ticks == TICKS - 1


def test_a_damaged_row_is_said(day: Path) -> None:
    data = bytearray(day.read_bytes())
    data[-read(day)[0].row.itemsize - 9] ^= 1
    day.write_bytes(data)
    with pytest.raises(RecordingError, match=f"is damaged at row {TICKS - 2}"):
        replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))


@pytest.mark.parametrize(
    "data", [b"", b"\n", b"{}\n", b'{"format": "mind recording 9"}\n', b"\xff\xfe", b"[" * 5000 + b"\n"]
)
def test_what_is_no_recording(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "x.rec").write_bytes(data)
    with pytest.raises(RecordingError, match="is no recording"):
        read(tmp_path / "x.rec")
    with pytest.raises(RecordingError, match="cannot read"):
        read(tmp_path / "none.rec")


def test_no_bit_of_the_first_line_can_flip(day: Path) -> None:
    data = day.read_bytes().partition(b"\n")[0] + b"\n"
    for place in range(0, 8 * len(data) - 8, 11):  # each bit of some bytes
        flipped = bytearray(data)
        flipped[place // 8] ^= 1 << place % 8
        day.write_bytes(flipped)
        with pytest.raises(RecordingError, match=r"is damaged|is no recording"):
            read(day)


@pytest.mark.parametrize("number", [1, 2, 4])
def test_a_recording_of_another_form_is_refused(day: Path, number: int) -> None:
    line, _, rows = day.read_bytes().partition(b"\n")
    day.write_bytes(saying(line, format=f"mind recording {number}") + rows)
    with pytest.raises(RecordingError, match=f"it is a 'mind recording {number}', not a .*; record it again, or"):
        read(day)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("readings", -1), ("readings", 10**9), ("readings", 4.0), ("readings", True), ("tick", 0), ("tick", "1"),
        ("tick", 10**400), ("sensors", "abc"), ("sensors", ["a", "a"]), ("sensors", [1]), ("skills", ["\x1b[2J"]),
        ("actuators", None), ("master", 7), ("bundle", ""), ("bundle", "AB" * 32),
    ],
)  # fmt: skip
def test_what_a_first_line_cannot_say(day: Path, name: str, value: object) -> None:
    line, _, rows = day.read_bytes().partition(b"\n")
    day.write_bytes(saying(line, **{name: value}) + rows)
    with pytest.raises(RecordingError, match="is no recording"):
        read(day)


@pytest.mark.parametrize(
    ("name", "value"),
    [("readings", 5), ("tick", 0.5), ("actuators", ["left_wheel"]), ("skills", ["Stay"]), ("sensors", ["pulse"])],
)
def test_other_columns_than_those_of_the_bundle_are_refused(day: Path, name: str, value: object) -> None:
    line, _, rows = day.read_bytes().partition(b"\n")
    day.write_bytes(saying(line, **{name: value}) + rows)
    for refuses in (
        lambda: replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {}))),
        lambda: _reported(day),
    ):
        with pytest.raises(RecordingError, match="other columns"):
            refuses()


def _reported(day: Path) -> object:
    return report(day, BUNDLE, graph("range_finder"))


def test_the_report_holds_it_against_the_contract(day: Path) -> None:
    lines = {line.what: line for line in report(day, BUNDLE, graph("range_finder"))}
    assert lines["tick"].kept
    assert lines["tick"].declared == "50.0 ms"
    assert not lines["ticks at neutral"].kept
    assert (lines["sense lost"].declared, lines["sense lost"].kept) == ("0.0%", False)
    assert lines["sense delay"].kept


def test_what_the_guardian_held_at_neutral_is_recorded_reported_and_summed_up(tmp_path: Path) -> None:
    of, path = robot("bearing", [good] * 7 + [bus_error]), tmp_path / "day.rec"
    failed, silent = "right_wheel failed: no answer", "no frame for two ticks"
    about = About.of(of.loop.engine.graph, BUNDLE, of.loop.engine.graph.master, ("sense",))
    with Recorder(path, about) as of.loop.recorder:
        for of.sent.holds in ("", failed, failed, failed, silent, "", failed, failed):
            of.tick()
    rows = np.concatenate([*read(path)[1]])
    assert rows["stopped"].tolist() == [0, 4, 4, 4, 2, 0, 4, 1], "what the loop stopped itself counts as that"
    lines = {line.what: (line.had, line.kept) for line in report(path, BUNDLE, of.loop.engine.graph)}
    assert lines["ticks at neutral"] == ("75.00%", False)
    assert lines["neutral: right_wheel failed"] == ("4 ticks, first after 0.05 s", False)
    assert lines["neutral: guardian"] == ("1 tick, first after 0.20 s", False)
    told = "1 at neutral because of a fault, 5 because of the guardian"
    assert f"{told} (4: right_wheel failed: no answer; 1: no frame for two ticks)" in _summary(of.loop)


@given(st.integers(0, 999))
def test_any_number_of_an_actuator_can_be_recorded(number: int) -> None:
    said = by_guardian(number)
    assert by_guardian(None) < said == min(3 + number, 255)


def test_what_is_not_armed_is_held_by_nobody() -> None:
    of = robot("bearing", [good])
    of.loop.armed, of.sent.holds = False, "no frame for two ticks"
    of.tick()
    assert not of.loop.held
    assert "guardian" not in _summary(of.loop)


def test_a_tick_has_64_bits(day: Path) -> None:
    about, path = read(day)[0], day.with_name("years.rec")
    with Recorder(path, about) as recorder:
        for tick in (2**32 - 1, 2**32, 2**63):
            recorder.write(tick=tick, time=1.0)
    assert [int(row["tick"]) for rows in read(path)[1] for row in rows] == [2**32 - 1, 2**32, 2**63]


def test_a_full_disk_is_told_with_the_name_of_the_file(day: Path) -> None:
    recorder = Recorder(day.with_name("more.rec"), read(day)[0])
    recorder._ending.set()
    recorder._syncing.join()
    recorder._file.close()
    with (
        Path("/dev/full").open("wb", buffering=0) as recorder._file,
        pytest.raises(RecordingError, match=r"more\.rec cannot be written: No space left on device"),
    ):
        recorder.write(tick=0)


@pytest.mark.parametrize("read_bytes", [100, 5_000, 1 << 20])
def test_it_is_read_in_parts(day: Path, monkeypatch: pytest.MonkeyPatch, read_bytes: int) -> None:
    whole = np.concatenate([*read(day)[1]])
    monkeypatch.setattr("mindrun.robot.recording.READ_BYTES", read_bytes)
    parts = [*read(day)[1]]
    assert max(map(len, parts)) <= max(1, read_bytes // whole.itemsize + 1)
    assert np.concatenate(parts).tobytes() == whole.tobytes()
    data = bytearray(day.read_bytes())
    data[-whole.itemsize - 9] ^= 1
    day.write_bytes(data)
    with pytest.raises(RecordingError, match=f"is damaged at row {TICKS - 2}"):
        replay(day, BUNDLE, ChangedEngine(Policy(graph("range_finder"), {})))


def test_it_is_brought_to_the_disk_beside_the_loop_and_in_the_end(day: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    synced: list[str] = []
    brought = Event()

    def sync(descriptor: int) -> None:
        synced.append(current_thread().name)
        if len(synced) > 2:
            brought.set()
        if len(synced) == 1:
            raise OSError(5, "Input/output error")  # which is the writer's to notice

    monkeypatch.setattr(os, "fsync", sync)
    with Recorder(day.with_name("more.rec"), read(day)[0], every=0.001) as recorder:
        recorder.write(tick=0, time=1.0)
        assert brought.wait(20)
    assert set(synced[:-1]) == {"recording"}
    assert synced[-1] == current_thread().name
    assert not recorder._syncing.is_alive()
    assert recorder._file._file.closed


def test_what_cannot_be_brought_to_the_disk_in_the_end_is_told(day: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recorder = Recorder(day.with_name("more.rec"), read(day)[0])

    def fail(descriptor: int) -> None:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(RecordingError, match=r"more\.rec cannot be written: Input/output error"):
        recorder.close()
    assert recorder._file._file.closed


@pytest.mark.parametrize(
    ("name", "value", "fine"),
    [
        ("readings", 0, True), ("readings", 1 << 20, True), ("readings", (1 << 20) + 1, False),
        ("tick", 1e-9, True), ("tick", 1e9, True), ("tick", 10**9, True), ("tick", 9e-10, False), ("tick", 1e10, False),
        ("tick", True, False), ("sensors", [], True), ("bundle", f"{BUNDLE}0", False), ("bundle", None, False),
        ("bundle", f"{BUNDLE[:-1]}g", False),
    ],
)  # fmt: skip
def test_the_bounds_of_a_first_line(day: Path, name: str, value: object, fine: bool) -> None:
    day.write_bytes(saying(day.read_bytes().partition(b"\n")[0], **{name: value}))
    if fine:
        assert getattr(read(day)[0], name) == (tuple(value) if isinstance(value, list) else value)
    else:
        with pytest.raises(RecordingError, match="is no recording"):
            read(day)


def test_nothing_is_written_over(day: Path) -> None:
    with pytest.raises(FileExistsError):
        Recorder(day, read(day)[0])
