"""`--on ssh:a,b` with an ssh that has no network: the shell there splits again what it is asked."""

import os
import shlex
import shutil
import sys
from pathlib import Path

import pytest

from tests.train.test_train_command import MIND
from tests.work.test_on import TAUGHT, called, weights

ROOT = Path(__file__).parents[2]
FAKES = Path(__file__).parents[1] / "deploy" / "fakes"
BENCHED = ("bench", "drive.mind", "--task", "Reach", "--runs", "70", "--csv", "runs.csv")


def put_mindrun(path: Path) -> None:
    """A `mindrun` of these sources, for a shell that has nothing of our environment."""
    kept = {"PYTHONPATH": f"{ROOT}{os.pathsep}{ROOT / 'runtime'}"}
    kept |= {name: value for name, value in os.environ.items() if name.startswith("NUMBA_")}
    kept |= {"XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME") or f"{Path.home() / '.cache'}"}  # else each compiles
    words = ["exec", "env", *(f"{name}={value}" for name, value in kept.items()), sys.executable, "-m", "mindrun"]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'#!/bin/sh\n{shlex.join(words)} "$@"\n')
    path.chmod(0o755)


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The home of all machines that ssh leads to, whose PATH has `mindrun`."""
    shutil.copy(FAKES / "ssh", tmp_path)
    put_mindrun(tmp_path / "robot" / "mindrun")
    monkeypatch.setenv("FAKE", str(tmp_path))
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    (tmp_path / "home").mkdir()
    return tmp_path / "home"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A mind with weights."""
    folder = tmp_path / "a mind"
    folder.mkdir()
    (folder / "drive.mind").write_text(MIND)
    assert called(folder, "train", "drive.mind", "Go", "Drive", "--seed", "3", "-q").returncode == 0
    return folder


def test_it_teaches_the_weights_of_threads(tmp_path: Path, home: Path) -> None:
    assert weights(tmp_path / "a b", "--on", "ssh:a,b") == weights(tmp_path / "threads")
    asked = (tmp_path / "ssh.log").read_text().splitlines()
    assert sorted(line.partition(" -- ")[2] for line in asked) == ["a mindrun work", "b mindrun work"]


@pytest.mark.parametrize("where", ["ssh:a,b", "command:ssh a \"'far away/mindrun' work --threads 1\""])
def test_it_makes_the_runs_of_threads(project: Path, home: Path, where: str) -> None:
    put_mindrun(home / "far away" / "mindrun")
    rows = []
    for words in ((), ("--on", where)):
        done = called(project, *BENCHED, *words)
        assert done.returncode == 0, done.stderr
        rows.append((project / "runs.csv").read_bytes())
    assert rows[0] == rows[1]
    assert f"by {where}, in" in " ".join(done.stdout.split())


def test_a_machine_that_is_not_there_is_one_sentence(project: Path, home: Path) -> None:
    done = called(project, *BENCHED, "--on", "ssh:unreachable")
    assert (done.returncode, done.stdout) == (1, "")
    assert "no worker is left; the last, at unreachable, ended: ssh: connect to host" in done.stderr
    assert "--resume" not in done.stderr  # nothing was saved of a bench
    taught = called(project, "train", *TAUGHT, "--on", "ssh:unreachable")
    assert (taught.returncode, "to go on: mindc train --resume runs/" in " ".join(taught.stderr.split())) == (1, True)


def test_one_of_two_machines_is_enough(project: Path, home: Path) -> None:
    assert called(project, *BENCHED, "--on", "ssh:unreachable,a").returncode == 0


def test_cores_of_this_machine_are_refused_beside_others(project: Path) -> None:
    done = called(project, *BENCHED, "--on", "ssh:a", "--workers", "2")
    assert (done.returncode, "with --on others make the runs" in done.stderr) == (2, True)
