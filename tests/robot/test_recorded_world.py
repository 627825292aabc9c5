"""The world of a recording: what a first line and rows say of one is believed only where it can be."""

import json
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.bundle import read_bundle
from mindrun.graph.recording_header import (
    CHECKSUM_FIELD,
    MAX_HEADER_BYTES,
    RecordedWorld,
    _sealed,
    about_of_line,
    line_of,
)
from mindrun.robot.recording import About, Recorder, RecordingError, read, recording_bytes
from mindrun.robot.replay import replay_recording

from mindlang.view.viewed_recording import viewed_recording
from tests.calling import Call

FOLDER = Path(__file__).parent / "recordings"
BUNDLE, REC, ROBOT_REC = (FOLDER / name for name in ("ball.bundle", "simulated.rec", "robot.rec"))
NUMBERS = st.none() | st.floats(-1e9, 1e9, exclude_min=True, exclude_max=True)


def resealed(line: bytes, **world: object) -> bytes:
    """The first line with something else said of its world, and the checksum that fits; None takes it away."""
    said = json.loads(line)
    del said["check"]
    for name, value in world.items():
        if value == "none":
            del said["world"][name]
        else:
            said["world"][name] = value
    return _sealed(json.dumps(said).encode()[:-1] + CHECKSUM_FIELD)


@pytest.mark.parametrize(
    "world",
    [
        {"task": 7}, {"task": "\x1b[2J"}, {"seed": -1}, {"seed": 1 << 64}, {"seed": 1.0}, {"seed": True},
        {"things": -1}, {"things": 2}, {"things": 10**9}, {"rewards": (1 << 20) + 1}, {"events": 1.5}, {"events": None},
        {"boxes": "abcd"}, {"boxes": [[1, 2, 3]]}, {"boxes": [[1, 2, 3, "4"]]}, {"boxes": [[1, 2, 3, 10**400]]},
        {"boxes": [1, 2, 3, 4]}, {"boxes": {}}, {"begin": []}, {"begin": [0] * 8}, {"begin": [True] * 7},
        {"begin": [1e10] * 7}, {"begin": None}, {"more": 1}, {"boxes": "none"}, {"task": "none"},
    ],
)  # fmt: skip
def test_what_a_first_line_cannot_say_of_a_world(world: dict[str, object]) -> None:
    line = REC.read_bytes().partition(b"\n")[0]
    with pytest.raises(RecordingError, match="is no recording of this mindrun: "):
        about_of_line(resealed(line, **world), REC)


def test_the_world_is_written_with_each_row(tmp_path: Path) -> None:
    about, parts = read(REC)
    rows = np.concatenate([*parts])
    worlds = iter(rows["world"])
    with Recorder(tmp_path / "copy.rec", about, world=lambda: next(worlds)) as recorder:
        for row in rows:
            recorder.write(**{name: row[name] for name in rows.dtype.names or () if name not in ("world", "check")})
    assert np.concatenate([*read(tmp_path / "copy.rec")[1]])["world"].tobytes() == rows["world"].tobytes()


@pytest.mark.parametrize("world", [None, 1, [], "Roam", {}])
def test_a_world_is_an_object(tmp_path: Path, world: object) -> None:
    said = json.loads(REC.read_bytes().partition(b"\n")[0])
    del said["check"]
    plain = json.dumps(said | {"world": world}).encode()[:-1]
    line = plain + CHECKSUM_FIELD + f"{zlib.crc32(plain):08x}".encode() + b'"}\n'
    with pytest.raises(RecordingError, match="what its world is"):
        about_of_line(line, tmp_path)


@pytest.mark.parametrize("world", [{"task": "Chase"}, {"rewards": 3}, {"events": 4}, {"things": 0, "begin": [0, 0, 0]}])
def test_another_world_than_that_of_the_task_is_refused(mindc: Call, tmp_path: Path, world: dict[str, object]) -> None:
    line, _, rows = REC.read_bytes().partition(b"\n")
    path = tmp_path / "day.rec"
    path.write_bytes(resealed(line, **world) + rows)
    with pytest.raises(RecordingError, match="other columns than its bundle"):
        replay_recording(path, BUNDLE)
    assert mindc("view", path, BUNDLE, "--no-browser").code == mindc("why", path, BUNDLE, "reward").code == 2


@given(
    st.text(st.characters(categories=["L", "N"]), min_size=1),
    st.integers(0, (1 << 64) - 1),
    st.lists(st.lists(st.floats(-1e9, 1e9), min_size=4, max_size=4), max_size=5),
    st.integers(0, 4).flatmap(lambda things: st.lists(NUMBERS, min_size=3 + 4 * things, max_size=3 + 4 * things)),
    st.integers(0, 9),
    st.integers(0, 9),
)
def test_a_world_that_is_written_is_read_again(
    task: str, seed: int, boxes: list[list[float]], begin: list[float | None], rewards: int, events: int
) -> None:
    things = (len(begin) - 3) // 4
    world = RecordedWorld(task, seed, things, rewards, events, tuple(map(tuple, boxes)), tuple(begin))
    about = replace(read(REC)[0], world=world)
    assert about_of_line(line_of(about), REC) == about


def test_a_master_that_the_bundle_does_not_have_is_refused(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "day.rec"
    path.write_bytes(recording_bytes(replace(read(REC)[0], master="Nobody"), np.concatenate([*read(REC)[1]])))
    for words in (("view", path, BUNDLE, "--no-browser"), ("why", path, BUNDLE, "left_wheel")):
        said = mindc(*words)
        assert said.code == 2
        assert "other columns than its bundle" in said.err


def test_a_world_that_is_too_large_leaves_no_file(tmp_path: Path) -> None:
    about = read(REC)[0]
    assert about.world
    large = replace(about, world=replace(about.world, boxes=((0.1, 0.2, 0.3, 0.4),) * (MAX_HEADER_BYTES // 20)))
    with pytest.raises(RecordingError, match="too many things and obstacles"):
        Recorder(tmp_path / "day.rec", large)
    assert not (tmp_path / "day.rec").exists()


@pytest.mark.parametrize("of", ["pose", "things", "rewards", "battery"])
@pytest.mark.parametrize("number", [np.nan, np.inf, -1e308])
def test_numbers_that_are_none_are_shown_as_none(tmp_path: Path, of: str, number: float) -> None:
    """A thing of no size or of less cannot be drawn: it is nowhere. Everything else is what the row says."""
    about, parts = read(REC)
    rows = np.concatenate([*parts])
    rows["world"][of][7] = number
    rows["world"]["held"][7], rows["world"]["ended"][-1] = 10**9, -77
    path = tmp_path / "day.rec"
    path.write_bytes(recording_bytes(about, rows))
    viewed = viewed_recording(path, BUNDLE)
    while not viewed.over:
        viewed.grow()
    assert (viewed.known, viewed.failed, viewed.ended_by) == (40, None, None)
    things = viewed.group("things", np.array([8]))
    assert np.isnan(things).all() if of == "things" else np.isfinite(things).all()


def test_a_cut_file_and_a_damaged_row(tmp_path: Path) -> None:
    data, path = REC.read_bytes(), tmp_path / "day.rec"
    path.write_bytes(data[:-1])
    assert sum(len(part) for part in read(path)[1]) == 39
    size = read(REC)[0].row.itemsize
    path.write_bytes(data[: -3 * size] + bytes([data[-3 * size] ^ 1]) + data[1 - 3 * size :])
    parts: list[int] = []
    with pytest.raises(RecordingError, match=r"is damaged at row 37$"):
        parts.extend(len(part) for part in read(path)[1])
    assert parts == [37]


def test_what_a_robot_without_a_world_wrote_is_written_and_computed_again() -> None:
    about, parts = read(ROBOT_REC)
    assert about.world is None
    graph = read_bundle(BUNDLE).graph
    again = About.of(graph, about.bundle, graph.master, about.sensors)
    assert recording_bytes(again, np.concatenate([*parts])) == ROBOT_REC.read_bytes()
    found = replay_recording(ROBOT_REC, BUNDLE)
    assert (found.ticks, found.differs) == (24, None)


def test_a_recording_is_seen_with_its_world() -> None:
    about, parts = read(REC)
    assert about.world
    assert (about.world.task, about.world.seed, about.world.things) == ("Roam", 3, 1)
    rows = np.concatenate([*parts])
    assert rows["world"]["ended"].tolist() == [-3] * 39 + [-1]
    assert len(set(rows["world"]["pose"][:, 0].tolist())) > 30
    viewed = viewed_recording(REC, BUNDLE)
    while not viewed.over:
        viewed.grow()
    assert viewed.failed is None
    assert viewed.group("robot", np.arange(1, 41)).tobytes() == rows["world"]["pose"].tobytes()
    assert len(viewed.about["world"]["boxes"]) == len(about.world.boxes) == 9
