"""Who was champion when: as the trainer kept it, and as it is read when the file is damaged."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.train import champion_log
from mindrun.train.champion_log import CHAMPION_ROWS, read_champions
from mindrun.train.lesson_state import begin
from mindrun.train.run_folder import RunFolder, create
from mindrun.train.training import train

from mindlang.view.learning import LearntRun
from mindlang.view.messages import RefusedError
from tests.train.climbing import LENGTH, Sphere, lesson, manifest, unwatched
from tests.train.sequential import teach

START = {"Climb": np.zeros(LENGTH, np.float32)}


def run_of(folder: Path, start: dict[str, np.ndarray] | None = None) -> RunFolder:
    return create(folder, manifest(lesson(35, attempts=2), weights=start), {}, start or {})


@pytest.mark.parametrize("start", [None, START])
def test_it_has_each_champion_from_its_generation_on(tmp_path: Path, start: dict[str, np.ndarray] | None) -> None:
    run = run_of(tmp_path, start)
    train(run, Sphere(), unwatched())
    course, expected, before = run.course(LENGTH), [], None
    for state, record in teach(course, Sphere(), begin(course), lambda: 0.0):
        ended = state.attempt == record.attempt
        champion = state.champions[-1].tobytes() if ended else state.now.champion[0].tobytes()
        if before != (record.attempt, champion):
            expected.append((record.attempt, record.generation, champion))
        before = record.attempt, champion
    found = read_champions(run.folder)
    assert [(*each.position, each.genome.tobytes()) for each in found] == expected
    assert {1, 2} == {each.attempt for each in found}
    assert len(found) > 4


def test_what_follows_a_damaged_row_is_left_out(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    train(run, Sphere(), unwatched())
    path, whole = run.folder / CHAMPION_ROWS, read_champions(run.folder)
    data = path.read_bytes()
    size = 12 + 4 * LENGTH
    begin_bytes = len(data) - size * len(whole)
    for at in range(0, len(data), 7):
        path.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :])
        found = read_champions(run.folder)
        assert len(found) == max(0, at - begin_bytes) // size
        path.write_bytes(data[:at])
        assert len(read_champions(run.folder)) == max(0, at - begin_bytes) // size


def test_a_file_that_is_full_changes_nothing_but_what_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    free, full = run_of(tmp_path / "free"), run_of(tmp_path / "full")
    expected, warnings = train(free, Sphere(), unwatched()), list[str]()
    kept = read_champions(free.folder)
    assert len(kept) > 4
    monkeypatch.setattr(champion_log, "MAX_ROWS_BYTES", 21 + 3 * (12 + 4 * LENGTH) + 5)
    watch = replace(unwatched(), warn=warnings.append)
    now = train(full, Sphere(), watch)
    assert [each.tobytes() for each in now.champions] == [each.tobytes() for each in expected.champions]
    assert [each.position for each in read_champions(full.folder)] == [each.position for each in kept[:3]]
    assert warnings == ["champions.rows is full: later champions are not kept by their generation"]
    learnt = LearntRun(full)
    learnt.read()
    assert learnt.champion(*kept[1].position).position == kept[1].position
    assert learnt.champion(*kept[2].position).position == kept[2].position
    for position in ((kept[2].attempt, kept[2].generation + 1), kept[-1].position):
        with pytest.raises(RefusedError, match="was full before"):
            learnt.champion(*position)


def test_a_run_that_was_begun_without_the_file_goes_on_with_it(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    train(run, Sphere(), unwatched(stop_after=15))
    (run.folder / CHAMPION_ROWS).unlink()
    assert read_champions(run.folder) == []
    train(run, Sphere(), unwatched())
    assert read_champions(run.folder)[0].position == (1, 16)
