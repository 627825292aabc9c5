"""`mindc train --on`: the same weights wherever they are taught, and one sentence where they cannot be."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.train.test_train_command import MIND, mindc

TAUGHT = ("drive.mind", "Go", "--seed", "3", "--generations", "6", "--attempts", "3", "--from-scratch", "--json")


def weights(folder: Path, *words: str) -> dict[str, str]:
    folder.mkdir()
    (folder / "drive.mind").write_text(MIND)
    done = mindc(folder, *TAUGHT, *words)
    assert done.returncode == 0, done.stderr
    found: dict[str, str] = json.loads(done.stdout)["weights"]
    return found


def test_the_weights_are_the_same_on_threads_and_on_workers(tmp_path: Path) -> None:
    expected = weights(tmp_path / "threads", "--on", "threads")
    assert weights(tmp_path / "processes", "--on", "processes:2") == expected
    assert weights(tmp_path / "command", "--on", f"command:{sys.executable} -m mindrun work --threads 1") == expected


@pytest.mark.parametrize(
    ("where", "words"),
    [
        ("moon", "nobody knows where 'moon' is"),
        ("processes:0", "it is not from 1 to 1024"),
        ("processes:many", "it is no whole number"),
        ("ssh:", "a machine has no name"),
        ("ssh:a,-oProxyCommand=x", "is no machine"),
        ("command:", "there are no words"),
        ("command:0:true", "there are not 1 to 1024 of them"),
        ("command:'a", "no closing quotation"),
    ],
)
def test_what_says_no_place_is_refused(tmp_path: Path, where: str, words: str) -> None:
    (tmp_path / "drive.mind").write_text(MIND)
    done = mindc(tmp_path, *TAUGHT, "--on", where)
    assert done.returncode == 2
    assert words in " ".join(done.stderr.split())
    assert not (tmp_path / "runs").exists()


def test_a_command_that_is_no_worker_leaves_a_run_that_goes_on(tmp_path: Path) -> None:
    (tmp_path / "drive.mind").write_text(MIND)
    done = mindc(tmp_path, *TAUGHT, "--on", "command:false")
    assert (done.returncode, "no worker is left" in done.stderr) == (1, True)
    done = mindc(tmp_path, *TAUGHT)
    assert done.returncode == 0, done.stderr


def test_a_worker_that_is_sent_no_frame_says_so() -> None:
    command = [sys.executable, "-m", "mindrun", "work"]
    done = subprocess.run(command, input=b"hello there, worker", capture_output=True, check=False)
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"standard input is no frame: it begins with b'hello th'" in done.stderr
