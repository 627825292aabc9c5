"""Event files for TensorBoard: what the log says, every generation once, whatever the process was killed in."""

import os
import signal
import struct
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path
from time import sleep

import pytest
from mindrun.train import RunError
from mindrun.train.lesson_state import Record
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder, create
from mindrun.train.training import Watch, train

from mindlang.training.event_files import FILE, FOLDER, SCORES, SPEED, EventFiles
from tests.calling import Call
from tests.train.climbing import Faulty, Sphere, forget, lesson, manifest, unwatched

pytest.importorskip("tensorboardX", reason="event files are written with tensorboardX")
GENERATIONS, ATTEMPTS = 12, 2
HEADER_BYTES, CHECKSUM_BYTES = 8, 4
Events = dict[str, dict[int, float]]  # by tag: the value of each step


@pytest.fixture
def run(tmp_path: Path) -> RunFolder:
    """A run that has not begun, of two attempts."""
    return create(tmp_path / "runs", manifest(lesson(GENERATIONS, attempts=ATTEMPTS)), {}, {})


def watched(run: RunFolder, stop_after: int = 10**9, events: EventFiles | None = None) -> None:
    """Train with event files, and stop after so many generations."""
    events, silent = events or EventFiles(run), unwatched(stop_after=stop_after)

    def report(_: object, record: Record) -> None:
        events.report(record, silent.clock())

    train(run, Sphere(), Watch(report, forget, silent.stop, silent.clock, save_every=silent.save_every))
    events.close()


def read(path: Path) -> Events:
    """An event file as TensorBoard reads it; every step of a tag once, in order."""
    from tensorboardX.proto.event_pb2 import Event

    data, at, found = path.read_bytes(), 0, Events()
    while at < len(data):
        [size] = struct.unpack_from("<Q", data, at)
        at += HEADER_BYTES + CHECKSUM_BYTES
        event = Event.FromString(data[at : at + size])
        at += size + CHECKSUM_BYTES
        for value in event.summary.value:
            steps = found.setdefault(value.tag, {})
            assert event.step > max(steps, default=0), "a step is there twice"
            steps[event.step] = value.simple_value
    return found


def all_of(run: RunFolder) -> dict[str, Events]:
    """What the event files of a run say, by their folder."""
    return {path.parent.name: read(path) for path in sorted((run.folder / FOLDER).glob(f"*/{FILE}"))}


def expected(run: RunFolder) -> dict[str, Events]:
    """What the log of a run says, as event files have it."""
    found: dict[str, Events] = {}
    for record in read_progress(run.folder):
        events = found.setdefault(f"attempt {record['attempt']}", {})
        shown = {tag: record[column] for tag, column in SCORES.items()}
        shown[SPEED] = (record["ticks"] or 0) / (record["seconds"] or 1)
        for tag, value in shown.items():
            if value is not None:
                single = struct.unpack("<f", struct.pack("<f", value))[0]
                events.setdefault(tag, {})[int(record["generation"] or 0)] = single
    return found


def test_every_figure_of_the_log_is_an_event(run: RunFolder) -> None:
    watched(run)
    found = all_of(run)
    assert found == expected(run)
    assert [*found] == ["attempt 1", "attempt 2"]
    assert [*found["attempt 1"]["score/best"]] == [*range(1, GENERATIONS + 1)]
    assert [*found["attempt 2"]["score/verdict"]] == [GENERATIONS]


@pytest.mark.parametrize("stops", [(1,), (5, 3), (GENERATIONS, 4), (GENERATIONS + 2, 1, 1)])
def test_what_goes_on_has_no_generation_twice(run: RunFolder, stops: tuple[int, ...]) -> None:
    for stop in stops:
        watched(run, stop)
        assert all_of(run) == expected(run)
    watched(run)
    assert all_of(run) == expected(run)
    assert len(all_of(run)["attempt 2"]["score/mean"]) == GENERATIONS


def test_generations_that_a_crash_took_back_are_gone(run: RunFolder) -> None:
    events = EventFiles(run)
    watched(run, 3)
    watched(run, GENERATIONS, events)
    (run.folder / "checkpoint").unlink(missing_ok=True)  # as if the newest had not reached the disk
    (run.folder / "checkpoint.previous").unlink(missing_ok=True)
    watched(run, 2)
    assert all_of(run) == expected(run)
    assert [*all_of(run)] == ["attempt 1"]
    assert [*all_of(run)["attempt 1"]["score/best"]] == [1, 2]


def test_a_run_that_has_ended_without_them_gets_them_all_the_same(run: RunFolder) -> None:
    train(run, Sphere(), unwatched())
    assert not (run.folder / FOLDER).exists()
    EventFiles(run).write_all()
    assert all_of(run) == expected(run)


def test_the_same_log_gives_the_same_bytes(run: RunFolder) -> None:
    watched(run)
    paths = sorted((run.folder / FOLDER).glob(f"*/{FILE}"))
    before = [path.read_bytes() for path in paths]
    EventFiles(run).write_all()
    assert [path.read_bytes() for path in paths] == before


def test_what_is_not_finite_is_no_event(run: RunFolder) -> None:
    events = EventFiles(run)

    def report(_: object, record: Record) -> None:
        events.report(record, 0.0)

    silent = unwatched()
    train(run, Faulty(above=-1e9), Watch(report, forget, silent.stop, silent.clock, save_every=silent.save_every))
    events.close()
    assert all_of(run) == expected(run)
    assert set(all_of(run)["attempt 1"]) == {SPEED}


def test_a_folder_in_the_way_is_one_sentence(run: RunFolder) -> None:
    (run.folder / FOLDER).write_text("in the way")
    with pytest.raises(RunError, match="cannot write to") as caught:
        watched(run)
    assert "without --tensorboard" in caught.value.hint


def test_without_the_package_the_command_says_how_to_get_it(
    mindc: Call, drive: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "tensorboardX", None)
    said = mindc("train", drive, "Go", "--tensorboard")
    assert (said.code, said.out) == (2, "")
    assert said.err.splitlines()[1:] == ["  pip install 'mindlang[tensorboard]'"]
    assert not Path("runs").exists()


def test_a_training_that_was_stopped_goes_on_in_the_same_files(mindc: Call, drive: Path) -> None:
    words = ["train", str(drive), "Go", "--seed", "3", "--generations", "150", "--from-scratch", "--tensorboard"]
    program = [sys.executable, "-c", "from mindlang.cli import main; main()", *words]
    with subprocess.Popen(program, env={**os.environ, "CI": "1"}, stderr=subprocess.PIPE, text=True) as first:
        while not (found := [*Path("runs").rglob(FILE)]) or not found[0].stat().st_size:
            assert first.poll() is None
            sleep(0.02)
        first.send_signal(signal.SIGINT)
        _, err = first.communicate()
    assert err.splitlines()[-1].endswith(" --tensorboard")
    done = mindc(*words)
    assert done.code == 0, done.err
    assert "to watch: tensorboard --logdir runs/" in done.err
    [path] = Path("runs").rglob(FILE)
    steps = read(path)["score/best"]
    log = read_progress(path.parents[2])
    assert [*steps] == [record["generation"] for record in log] == [*range(1, 151)]


def test_an_event_file_says_no_more_than_a_record_has() -> None:
    assert set(SCORES.values()) <= set(asdict(Record(1, 1, 0.0, 0.0, None, None, 0, 0.0, 0)))
