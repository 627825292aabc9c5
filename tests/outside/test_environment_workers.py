"""Environments are stepped in processes: the same bits for any number; what one does wrong there is one sentence."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gymnasium")

import numpy as np
from mindrun.graph.bundle import Bundle
from mindrun.graph.bundle import pack as pack_bundle
from mindrun.graph.policy import Policy
from mindrun.sim.outside.subprocess_stepper import VARIABLE

from mindlang.executors.jobs import Assignment, JobScorer
from mindlang.executors.processes import ProcessJobs
from tests.calling import caller
from tests.executors.test_on_dask import cluster_on_this_machine
from tests.outside import minds

ROOT = Path(__file__).parents[2]
LESSON = "curriculum School is genetic population 8 layouts 2\n  teaches Go on Go for 3 generations\n"


def project(folder: Path, world: str, lesson: str = LESSON) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "go.mind").write_text(minds.text(scene=f"tests.outside.kept:{world}-v0") + lesson)
    return folder


def short(lesson: str) -> str:
    """The same lesson, in which hardly anything is learnt."""
    return lesson.replace("population 8", "population 4").replace("for 3 generations", "for 1 generations")


def mindc(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    return subprocess.run(
        [sys.executable, "-c", "from mindlang.cli import main; main()", *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )


def taught(folder: Path, *words: str, world: str = "Line") -> dict[str, str]:
    lesson = LESSON.replace("layouts 2", "layouts 2 attempts 2 rungs 1")
    done = mindc(project(folder, f"tests/{world}", lesson), "train", "go.mind", "--seed", "1", "--json", *words)
    assert done.returncode == 0, done.stderr
    weights: dict[str, str] = json.loads(done.stdout)["weights"]
    return weights


@pytest.mark.slow
def test_the_weights_are_those_of_any_number_of_processes(tmp_path: Path) -> None:
    expected = taught(tmp_path / "one", "--workers", "1")
    assert taught(tmp_path / "three", "--workers", "3") == expected
    assert taught(tmp_path / "attempts", "--on", "processes:2") == expected  # each attempt in a process
    assert taught(tmp_path / "talking", "--workers", "2", world="Talking") == expected


@pytest.mark.slow
def test_the_weights_are_those_of_a_cluster_which_tells_a_step_that_never_ends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setenv(VARIABLE, "5")
    expected = taught(tmp_path / "here", "--workers", "1")
    for address in cluster_on_this_machine(tmp_path):
        assert taught(tmp_path / "there", "--on", f"dask:{address}") == expected
        folder = project(tmp_path / "hanging", "tests/Hanging")
        done = mindc(folder, "train", "go.mind", "--seed", "1", "--on", f"dask:{address}")
        assert "does not come back from step 3 of the run of" in " ".join(done.stderr.split())
        assert done.returncode == 1


def test_many_runs_are_the_same_in_any_number_of_processes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    found, call = [], caller(capsys, monkeypatch)
    mind, table = project(tmp_path / "line", "tests/Line", short(LESSON)) / "go.mind", tmp_path / "runs.csv"
    assert call("train", mind, "--seed", 1, "--runs", tmp_path / "runs", "-q").code == 0
    for workers in (1, 2):
        said = call("bench", mind, "--runs", 70, "--csv", table, "--workers", workers)
        assert said.code == 0, said.err
        assert "note: readings beyond their range: place in " in said.err
        found.append((table.read_bytes(), said.err.splitlines()[-2]))
    assert found[0] == found[1]


@pytest.mark.slow
def test_a_module_beside_the_mind_is_found_from_elsewhere(tmp_path: Path) -> None:
    folder = tmp_path / "beside"
    folder.mkdir()
    (folder / "go.mind").write_text(minds.text(scene="beside_me:Mine-v0") + LESSON)
    (folder / "beside_me.py").write_text(
        "import gymnasium\nfrom tests.outside.worlds import Line\ngymnasium.register('Mine-v0', Line)\n"
    )
    for on in ((), ("--on", "processes:1")):
        done = mindc(tmp_path, "train", "beside/go.mind", "--seed", "1", "-q", "--force", *on)
        assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("world", "words"),
    [
        ("Blind", ("Go has learnt nothing: on 100 of 100 fresh layouts a reward or a command",)),
        ("Dying", ("the environment tests.outside.kept:tests/Dying-v0 has ended its process", "It was in step 3 of the",
                   "SIGABRT", "--resume")),
    ],
)  # fmt: skip
def test_what_an_environment_does_wrong_in_a_process_is_one_message(
    tmp_path: Path, world: str, words: tuple[str, ...]
) -> None:
    folder = project(tmp_path, f"tests/{world}")
    on = ("--on", "processes:2")
    done = mindc(folder, "train", "go.mind", "--seed", "1", *on)
    assert done.returncode == 1
    assert all(each in " ".join(done.stderr.split()) for each in words), done.stderr
    assert not (folder / "go.lock").exists()
    assert workers_of(folder) == []


@pytest.mark.slow
def test_workers_end_with_who_asked_them_even_in_a_step_that_hangs(tmp_path: Path) -> None:
    folder = project(tmp_path, "tests/Crowded")
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    words = [sys.executable, "-c", "from mindlang.cli import main; main()", "train", "go.mind", "--workers", "2"]
    asking = subprocess.Popen(words, cwd=folder, env={**os.environ, "PYTHONPATH": path}, stderr=subprocess.DEVNULL)
    until(lambda: sum("spawn_main" in each for each in workers_of(folder)) == 2)
    asking.kill()
    asking.wait()
    until(lambda: workers_of(folder) == [])


def test_a_process_ends_with_its_jobs_whatever_threads_an_environment_has_left() -> None:
    rollout = minds.rollout_of(minds.text(scene="tests.outside.kept:tests/Threaded-v0"))
    bundle = pack_bundle(Bundle(Policy(rollout.graph, {"Go": minds.genomes(rollout, 1)[0]}), {}))
    jobs = ProcessJobs(1, 1, Assignment(bundle, "Go", "Go", folder=ROOT))
    try:
        assert (JobScorer(rollout, jobs).score(np.zeros((1, 0), np.float32), [1]).ticks > 0).all()
        process = jobs.members[0].process
    finally:
        jobs.close()
    assert process is not None
    assert process.exitcode is not None


def until(holds: Callable[[], bool]) -> None:
    """Wait for it, not for ever."""
    for _ in range(600):
        if holds():
            return
        time.sleep(0.1)
    raise AssertionError("it never came to that")


def workers_of(folder: Path, state: str = "") -> list[str]:
    """The processes that work in a folder, those in a state of Linux alone where one is given: T of what is stopped."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            now = process.joinpath("stat").read_text().rpartition(")")[2].split()[0]
            if state in now and process.joinpath("cwd").readlink() == folder.resolve():
                found.append(process.joinpath("cmdline").read_text())
        except OSError:
            continue
    return found
