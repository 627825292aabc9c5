"""A run that is killed and resumed ends in the same bits as one that was not."""

import random
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import sleep

from mindrun.graph.graph import HardLayouts
from mindrun.train.champion_log import CHAMPION_ROWS
from mindrun.train.manifest import Manifest
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder, create
from mindrun.train.training import train

from tests.train.climbing import Sphere, lesson, manifest, unwatched

KILLS = 3
CLIMB = Path(__file__).with_name("climb.py")


def made(runs: Path) -> RunFolder:
    return create(runs, manifest(lesson(200, attempts=3)), {}, {})


def end(run: RunFolder) -> tuple[bytes, bytes, bytes, list[dict[str, float | None]]]:
    records = [
        {key: value for key, value in record.items() if key != "seconds"} for record in read_progress(run.folder)
    ]
    files = ((run.folder / name).read_bytes() for name in ("weights.npy", "champions.npy", CHAMPION_ROWS))
    return *files, records


def test_killed_at_random_moments_it_ends_in_the_same_bits(tmp_path: Path) -> None:
    undisturbed, disturbed = made(tmp_path), made(tmp_path)
    train(undisturbed, Sphere(), unwatched())
    moments = random.Random(0)
    codes = [live(disturbed, moments.uniform(0, 0.06)) for _ in range(KILLS)]
    assert codes == [-signal.SIGKILL] * KILLS
    assert len(read_progress(disturbed.folder)) < 600
    assert subprocess.run([sys.executable, CLIMB, disturbed.folder], capture_output=True, check=False).returncode == 0
    assert end(disturbed) == end(undisturbed)


def live(run: RunFolder, seconds: float) -> int:
    with subprocess.Popen([sys.executable, CLIMB, run.folder, "", "0.001"], stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.readline()
        sleep(seconds)
        process.kill()
        return process.wait()


def test_stopped_and_resumed_after_any_generation_it_ends_in_the_same_bits(tmp_path: Path) -> None:
    stops_after_any_generation(tmp_path, manifest(lesson(5, attempts=2)))


def test_what_an_attempt_has_been_waiting_for_is_not_forgotten(tmp_path: Path) -> None:
    records = stops_after_any_generation(tmp_path, manifest(lesson(24, attempts=2, patience=3)), 5)
    assert len(records) < 48


def test_how_high_attempts_have_climbed_is_not_forgotten(tmp_path: Path) -> None:
    records = stops_after_any_generation(tmp_path, manifest(lesson(16, attempts=4, rungs=2)), 5)
    assert len(records) < 64


def test_hard_layouts_are_drawn_at_the_same_addresses_after_a_stop(tmp_path: Path) -> None:
    hard = replace(lesson(5, attempts=2, layouts=3), hard=HardLayouts(0.25, ("3", "5", "7")))
    stops_after_any_generation(tmp_path, manifest(hard))


def stops_after_any_generation(tmp_path: Path, course: Manifest, every: int = 1) -> list[dict[str, float | None]]:
    """Stop after a generation, or after one of `every` so many; the log of the run that was not stopped."""
    undisturbed = create(tmp_path, course, {}, {})
    train(undisturbed, Sphere(), unwatched())
    records = end(undisturbed)[-1]
    for generations in range(1, len(records), every):
        stopped = create(tmp_path, course, {}, {})
        train(stopped, Sphere(), unwatched(stop_after=generations))
        train(stopped, Sphere(), unwatched())
        assert end(stopped) == end(undisturbed)
    return records


def test_a_finished_run_that_is_resumed_stays_as_it_is(tmp_path: Path) -> None:
    run = create(tmp_path, manifest(lesson(5)), {}, {})
    first = train(run, Sphere(), unwatched())
    before = end(run)
    assert train(run, Sphere(), unwatched()).reevaluated == first.reevaluated
    assert end(run) == before


def test_the_previous_checkpoint_gives_the_same_bits(tmp_path: Path) -> None:
    course = manifest(lesson(9))
    undisturbed, damaged = create(tmp_path, course, {}, {}), create(tmp_path, course, {}, {})
    train(undisturbed, Sphere(), unwatched())
    train(damaged, Sphere(), unwatched(0.0, 4))
    (damaged.folder / "checkpoint").write_bytes(b"half a check")
    train(damaged, Sphere(), unwatched())
    assert end(damaged) == end(undisturbed)
