"""Who was champion when: as the trainer kept it, and as it is read when the file is damaged."""

from pathlib import Path

import numpy as np
import pytest
from mindrun.train.champion_log import CHAMPION_ROWS, read_champions
from mindrun.train.lesson import teach
from mindrun.train.lesson_state import begin
from mindrun.train.run_folder import RunFolder, create
from mindrun.train.training import train

from tests.train.climbing import LENGTH, Sphere, lesson, manifest, unwatched

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
        champion = state.champions[-1].tobytes() if ended else state.champion[0].tobytes()
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


def test_a_run_that_was_begun_without_the_file_goes_on_with_it(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    train(run, Sphere(), unwatched(stop_after=15))
    (run.folder / CHAMPION_ROWS).unlink()
    assert read_champions(run.folder) == []
    train(run, Sphere(), unwatched())
    assert read_champions(run.folder)[0].position == (1, 16)
