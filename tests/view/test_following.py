"""A recording that is seen while it is written: the rows of the whole, however its bytes come."""

import os
from collections.abc import Callable
from itertools import chain, pairwise, repeat
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, digest, write_bundle
from mindrun.robot.recording import (
    MAX_EMPTY_PARTS,
    MAX_HEADER_BYTES,
    About,
    Recorder,
    RecordingError,
    read,
    read_growing,
)

from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import followed_recording, remote, viewed_recording
from tests.calling import Call
from tests.view.serving import served
from tests.view.test_recording import MIND, mind

TICKS = 300
NAME = Path("day.rec")


def write_rows(recorder: Recorder, engine: Engine, first: int, below: int) -> None:
    """Ticks of a robot that reads noise."""
    rng = np.random.default_rng(first)
    for tick in range(first, below):
        readings = np.full(engine.graph.width, np.nan, np.float32)
        readings[:3] = rng.random(3)
        commands = engine.tick(readings)
        recorder.write(
            tick=tick, time=5 + tick / 20, stopped=0, armed=1, faults=[0], ages=[0.0], readings=engine.readings,
            influence=engine.influence, commands=commands, sent=commands,
        )  # fmt: skip


class Growing:
    """A recording that is written beside a test."""

    def __init__(self, folder: Path) -> None:
        self.rec, self.bundle = folder / "day.rec", folder / "ball.bundle"
        policy = mind(MIND)
        write_bundle(self.bundle, Bundle(policy, {}))
        self.engine = Engine(policy)
        self.about = About.of(policy.graph, digest(self.bundle), policy.graph.master, ("sense",))


@pytest.fixture(scope="module")
def day(tmp_path_factory: pytest.TempPathFactory) -> Growing:
    """One that is over."""
    found = Growing(tmp_path_factory.mktemp("day"))
    with Recorder(found.rec, found.about) as recorder:
        write_rows(recorder, found.engine, 0, TICKS)
    return found


def grown(viewed: Viewed, ticks: int) -> None:
    """Let it grow until so many ticks are known, or it is over."""
    while viewed.known < ticks and not viewed.over:
        viewed.grow()


@given(data=st.data())
def test_the_rows_are_those_of_the_whole_however_the_bytes_are_cut(day: Growing, data: st.DataObject) -> None:
    written = day.rec.read_bytes()
    head = written.index(b"\n") + 1
    end = data.draw(st.integers(head, len(written)))
    cuts = data.draw(st.lists(st.integers(0, end), max_size=12))
    parts = [written[first:below] for first, below in pairwise([0, *sorted(cuts), end])]
    about, rows = read_growing(NAME, iter(parts))
    assert about == day.about
    expected = np.concatenate([*read(day.rec)[1]])[: (end - head) // about.row.itemsize]
    assert np.concatenate([*rows]).tobytes() == expected.tobytes()


@given(place=st.floats(0, 1, exclude_max=True), size=st.integers(1, 5000))
def test_a_damaged_row_is_said_behind_those_before_it(day: Growing, place: float, size: int) -> None:
    written = bytearray(day.rec.read_bytes())
    head = written.index(b"\n") + 1
    at = head + int(place * (len(written) - head))
    written[at] ^= 4
    damaged = (at - head) // day.about.row.itemsize
    _, rows = read_growing(NAME, (bytes(written[n : n + size]) for n in range(0, len(written), size)))
    seen: list[int] = []
    with pytest.raises(RecordingError, match=f"damaged at row {damaged}$"):
        seen.extend(len(part) for part in rows)
    assert sum(seen) == damaged


@pytest.mark.parametrize(
    "parts",
    [
        [b"{}\n"], [b"x" * MAX_HEADER_BYTES], [b"x" * (1 << 16)] * 40, [b""] * MAX_EMPTY_PARTS, [],
        ["{\"format\": \"mind recording \u202e<img src=x onerror=alert(1)>\"}\n".encode()],
    ],
)  # fmt: skip
def test_what_is_no_recording_is_refused(parts: list[bytes]) -> None:
    with pytest.raises(RecordingError, match=r"no recording|no first line"):
        read_growing(NAME, chain(parts, repeat(b"", MAX_EMPTY_PARTS if parts and not parts[0] else 0)))


def test_ticks_come_as_they_are_written(tmp_path: Path) -> None:
    day = Growing(tmp_path)
    with Recorder(day.rec, day.about) as recorder:
        write_rows(recorder, day.engine, 0, 7)
        with (
            followed_recording(str(day.rec), day.bundle) as viewed,
            served(viewed) as view,
            view.viewer() as viewer,
        ):
            about = viewer.hear("about")
            assert (about["source"], about["of_ticks"]) == ("robot", None)
            for below in (7, 8, 30, TICKS):
                write_rows(recorder, day.engine, viewed.known, below)
                while viewer.hear("ticks")["known"] < below:  # nobody has asked for more
                    pass
    whole = viewed_recording(day.rec, day.bundle)
    grown(whole, TICKS)
    ticks = np.arange(TICKS + 1)
    assert viewed.singles(ticks).tobytes() == whole.singles(ticks).tobytes()
    assert viewed.doubles(ticks).tobytes() == whole.doubles(ticks).tobytes()


def test_half_a_row_waits_for_the_rest_and_is_no_mistake(tmp_path: Path) -> None:
    """A writer that is killed leaves one."""
    day = Growing(tmp_path)
    with Recorder(day.rec, day.about) as recorder:
        write_rows(recorder, day.engine, 0, 50)
    with day.rec.open("ab") as file:
        file.write(b"half a row")
    with followed_recording(str(day.rec), day.bundle) as viewed:
        grown(viewed, 50)
        viewed.grow()
    assert (viewed.known, viewed.over, viewed.failed) == (50, False, None)


def replaced(day: Growing) -> None:
    """Another file of that name."""
    other = day.rec.with_name("other")
    other.write_bytes(day.rec.read_bytes())
    other.replace(day.rec)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (replaced, "replaced or removed"),
        (lambda day: day.rec.unlink(), "cannot read|replaced or removed"),
        (lambda day: os.truncate(day.rec, 40), "shorter than it was"),
    ],
)
def test_a_file_that_is_another_now_ends_it_with_a_sentence(
    tmp_path: Path, change: Callable[[Growing], object], said: str
) -> None:
    day = Growing(tmp_path)
    with Recorder(day.rec, day.about) as recorder:
        write_rows(recorder, day.engine, 0, 5)
    with followed_recording(str(day.rec), day.bundle) as viewed:
        grown(viewed, 5)
        change(day)
        grown(viewed, 6)
    assert (viewed.known, viewed.over) == (5, True)
    assert viewed.failed
    assert any(words in viewed.failed for words in said.split("|"))


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("robot.local:day.rec", ("robot.local", "day.rec")),
        ("me@10.0.0.7:/var/day of mind.rec", ("me@10.0.0.7", "/var/day of mind.rec")),
        ("h:-rf; rm '$HOME'\n:x", ("h", "-rf; rm '$HOME'\n:x")),
        ("folder/a:b.rec", None),
        ("day.rec", None),
    ],
)
def test_a_file_of_another_machine(name: str, found: tuple[str, str] | None) -> None:
    assert remote(name) == found


@pytest.mark.parametrize("name", ["-oProxyCommand=x:day.rec", "a b:c", ":c", "me@-x:c", "h:", "$(x):c", "a:b\0", "ä:b"])
def test_what_names_no_host_is_refused(name: str) -> None:
    with pytest.raises(RecordingError, match="names no host"):
        remote(name)


@pytest.fixture
def ssh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A program in the place of ssh that runs what it is told on this machine, as a shell of the host would."""
    program = tmp_path / "bin" / "ssh"
    program.parent.mkdir()
    program.write_text('#!/bin/sh\n[ "$1 $2" = "-T --" ] || exit 9\n[ "$3" = gone ] && exit 255\nexec sh -c "$4"\n')
    program.chmod(0o700)
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")


@pytest.mark.usefixtures("ssh")
def test_a_robot_is_seen_through_ssh(tmp_path: Path, day: Growing) -> None:
    rec = tmp_path / "a day's $(touch harm); touch harm.rec"
    rec.write_bytes(day.rec.read_bytes())
    with followed_recording(f"robot:{rec}", day.bundle) as viewed:
        grown(viewed, TICKS)
    assert (viewed.known, viewed.failed) == (TICKS, None)
    assert not (tmp_path / "harm").exists()


@pytest.mark.usefixtures("ssh")
def test_a_connection_that_ends_is_said(day: Growing, mindc: Call) -> None:
    said = mindc("view", "gone:day.rec", day.bundle, "--follow", "--no-browser")
    assert (said.code, said.out) == (2, "")
    assert "the connection to gone has ended (ssh: exit 255)" in said.err


def test_what_cannot_be_followed(day: Growing, mindc: Call, tmp_path: Path) -> None:
    assert mindc("view", day.rec, "--follow").code == 2
    assert mindc("view", day.rec, day.bundle, "--follow", "--seed", 3).code == 2
    missing = mindc("view", tmp_path / "none.rec", day.bundle, "--follow", "--no-browser")
    assert (missing.code, missing.out) == (2, "")
    assert "none.rec" in missing.err
