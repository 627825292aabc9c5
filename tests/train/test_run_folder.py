"""Run folders: complete by themselves, one process each, never overwritten."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mindrun.train import RunError, checkpoint
from mindrun.train.lesson_state import LessonState, Record
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder, claim, create, open_run
from mindrun.train.training import Watch, train

from tests.train.climbing import Sphere, lesson, manifest, unwatched

WEIGHTS = {"Climb": np.arange(12, dtype=np.float32), "Go+Avoid": np.ones(3, np.float32)}


def made(runs: Path, generations: int = 6) -> RunFolder:
    return create(runs, manifest(lesson(generations)), {"climb.mind": "master Climb\n"}, {})


def test_a_run_is_found_again_as_it_was_made(tmp_path: Path) -> None:
    made_one = create(tmp_path, manifest(lesson(), weights=WEIGHTS), {"climb.mind": "master Climb\n"}, WEIGHTS)
    again = open_run(made_one.folder)
    assert again.manifest == made_one.manifest
    assert again.course(12).start.tolist() == [list(range(12))]
    assert (again.folder / "source" / "climb.mind").read_text() == "master Climb\n"


def test_the_folder_is_named_by_lesson_time_and_seed_and_never_used_twice(tmp_path: Path) -> None:
    names = [made(tmp_path).folder.relative_to(tmp_path).as_posix() for _ in range(3)]
    assert names == [f"Climb/20260714T120000Z-1{again}" for again in ("", "+2", "+3")]


def test_a_finished_run_has_everything(tmp_path: Path) -> None:
    run = made(tmp_path)
    state = train(run, Sphere(), unwatched())
    assert [record["generation"] for record in read_progress(run.folder)] == [1, 2, 3, 4, 5, 6]
    assert (run.folder / "progress.csv").read_text().count("\n") == 7
    np.testing.assert_array_equal(np.load(run.folder / "weights.npy"), state.kept[0])
    json.loads((run.folder / "manifest.json").read_text())


def test_it_is_saved_every_two_seconds_and_in_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    now, saved, reported = [0.0], [], []
    save = checkpoint.save

    def counted(folder: Path, state: LessonState, run: str) -> None:
        saved.append(state.now.population.generation)
        save(folder, state, run)

    def report(state: LessonState, record: Record) -> None:
        reported.append((state.now.population.generation, record.generation))
        now[0] += 0.5

    monkeypatch.setattr(checkpoint, "save", counted)
    watch = Watch(report, lambda warning: None, lambda: len(reported) == 10, lambda: now[0])
    state = train(made(tmp_path, 99), Sphere(), watch)
    assert saved == [4, 8, 10]
    assert reported == [(number, number) for number in range(1, 11)]
    assert state.now.population.generation == 10


def test_a_run_that_is_stopped_leaves_the_best_so_far(tmp_path: Path) -> None:
    run = create(tmp_path, manifest(lesson(6, attempts=2)), {}, {})
    state = train(run, Sphere(), unwatched(stop_after=3))
    np.testing.assert_array_equal(np.load(run.folder / "weights.npy"), state.now.champion[0])
    assert not (run.folder / "champions.npy").exists()
    state = train(run, Sphere(), unwatched(stop_after=5))
    np.testing.assert_array_equal(np.load(run.folder / "weights.npy"), state.kept[0])
    np.testing.assert_array_equal(np.load(run.folder / "champions.npy"), state.champions)
    assert (len(state.champions), state.now.population.generation) == (1, 2)


def test_a_run_leaves_no_file_open(tmp_path: Path) -> None:
    train(made(tmp_path), Sphere(), unwatched())
    before = len(list(Path("/proc/self/fd").iterdir()))
    train(made(tmp_path), Sphere(), unwatched())
    assert len(list(Path("/proc/self/fd").iterdir())) == before


def test_lines_after_the_checkpoint_are_dropped_and_written_again(tmp_path: Path) -> None:
    run = made(tmp_path)
    train(run, Sphere(), unwatched(stop_after=3))
    for name, late in (("progress.jsonl", b'{"half a li'), ("progress.csv", b"1,4,")):
        with (run.folder / name).open("ab") as file:
            file.write(late)
    lines = (run.folder / "progress.jsonl").read_text().splitlines()
    (run.folder / "progress.jsonl").write_text("\n".join([*lines[:3], lines[2].replace(": 3,", ": 4,", 1), lines[3]]))
    train(run, Sphere(), unwatched())
    assert [record["generation"] for record in read_progress(run.folder)] == [1, 2, 3, 4, 5, 6]


def test_two_processes_cannot_use_one_folder(tmp_path: Path) -> None:
    run = made(tmp_path)
    with claim(run.folder):
        code = f"from pathlib import Path; from mindrun.train.run_folder import claim; claim(Path({str(run.folder)!r}))"
        other = subprocess.run(
            [sys.executable, "-c", f"{code}.__enter__()"], capture_output=True, text=True, check=False
        )
    assert f"in use by process {os.getpid()}" in other.stderr


def test_the_lock_of_a_dead_process_is_taken_over(tmp_path: Path) -> None:
    run = made(tmp_path)
    (run.folder / "lock").write_text("1\n")  # a process that lives, but does not hold the lock
    train(run, Sphere(), unwatched())
    assert (run.folder / "lock").read_text() == f"{os.getpid()}\n"


@pytest.mark.parametrize("name", ["manifest.json", "start.npz"])
def test_a_damaged_part_is_refused(tmp_path: Path, name: str) -> None:
    run = create(tmp_path, manifest(lesson(), weights=WEIGHTS), {}, WEIGHTS)
    data = (run.folder / name).read_bytes()
    for damaged in (b"", data[: len(data) // 2], b"[]", b"\xff" * 100):
        (run.folder / name).write_bytes(damaged)
        with pytest.raises(RunError, match="damaged"):
            open_run(run.folder)


def test_a_folder_that_is_no_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="is not a run"):
        open_run(tmp_path)


def test_a_folder_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "runs").write_text("a file where the folder should be")
    with pytest.raises(RunError, match="cannot write a run under"):
        made(tmp_path / "runs")


def test_a_full_disk_leaves_the_last_checkpoint_and_the_run_goes_on_later(tmp_path: Path) -> None:
    run = made(tmp_path, generations=80)
    code = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))"
    full = climb(run.folder, code)
    assert full.returncode == 1
    assert full.stderr == f"cannot write to {run.folder}: File too large\n"
    assert climb(run.folder).returncode == 0
    undisturbed = made(tmp_path, generations=80)
    train(undisturbed, Sphere(), unwatched())
    assert (run.folder / "weights.npy").read_bytes() == (undisturbed.folder / "weights.npy").read_bytes()
    assert [record["generation"] for record in read_progress(run.folder)] == list(range(1, 81))


def climb(folder: Path, before: str = "") -> "subprocess.CompletedProcess[str]":
    script = Path(__file__).with_name("climb.py")
    return subprocess.run(
        [sys.executable, str(script), str(folder), before], capture_output=True, text=True, check=False
    )
