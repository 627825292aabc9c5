"""`mindc train`, as its users call it."""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path
from time import sleep

import pytest

from tests.calling import Call

MIND = """\
tick 1/60 s
master Drive
body Robot is disc
actuator left_wheel is wheel side left thrust 80 neutral 0.5
actuator right_wheel is wheel side right thrust 80 neutral 0.5
sensor bearing is bearing of object
skill Go is mlp hidden 1
  reads bearing
  drives left_wheel
  drives right_wheel
skill Drive is mlp hidden 1
  reads bearing
  influences Go
  drives left_wheel
task Reach in plain
  contains object is item size 3 reached moves
  lasts 100 ticks
  rewards 10 on reach of object
  rewards progress toward object per tick
task Broken in plain
  contains object is item size 3
  lasts 10 ticks
  rewards 1 / (forward - forward) per tick
curriculum School is genetic population 8
  teaches Go on Reach for 3 generations
  teaches Drive on Reach for 2 generations
curriculum Rest is genetic population 8
  teaches Go on Broken for 2 generations
"""

TRAIN = (sys.executable, "-c", "from mindlang.cli import main; main()", "train")
LONG = ("drive.mind", "Go", "--seed", "3", "--generations", "200", "--from-scratch", "--json")


def train_apart(folder: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    """The command in a process of its own, in a folder."""
    environment = {**os.environ, "CI": "1"}
    return subprocess.run(
        [*TRAIN, *arguments], cwd=folder, capture_output=True, text=True, check=False, env=environment
    )


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("CI", "1")
    (tmp_path / "drive.mind").write_text(MIND)
    return tmp_path


@pytest.fixture
def train(mindc: Call, project: Path) -> Call:
    """The command in this process, in the folder of the project."""
    return partial(mindc, "train")


def test_all_lessons_are_taught_in_order_and_then_there_is_nothing_to_do(train: Call, project: Path) -> None:
    done = train("drive.mind", "--seed", "1", "--json")
    assert done.code == 0, done.err
    results = [json.loads(line) for line in done.out.splitlines()]
    assert [result["skill"] for result in results] == ["Go", "Drive"]
    for result in results:
        folder = project / result["run"]
        assert re.fullmatch(r"runs/[\w-]+/\d{8}T\d{6}Z-1", result["run"])
        assert {path.name for path in folder.iterdir()} >= {
            "manifest.json",
            "progress.jsonl",
            "checkpoint",
            "weights.npy",
        }
        assert (project / "weights" / f"{result['weights'][result['skill']]}.npy").exists()
    again = train("drive.mind", "--json")
    assert (again.code, again.out) == (0, "")
    assert "nothing to do" in again.err


def test_any_number_of_workers_gives_the_same_bits(train: Call, project: Path) -> None:
    runs = [train("drive.mind", "Go", "--seed", "5", "--from-scratch", "--workers", n, "--json") for n in "123"]
    assert len({json.dumps(json.loads(run.out)["weights"]) for run in runs}) == 1


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (("drive.mind", "Drive"), 1, "first: mindc train"),
        (("drive.mind", "Goo"), 2, "Did you mean Go?"),
        (("drive.mind", "--curriculum", "Scool"), 2, "Did you mean School?"),
        (("drive.mind", "--curriculum", "Rest", "Go"), 1, "was no finite number"),
        (("none.mind",), 2, "cannot be read"),
        ((), 2, "Say what to train"),
        (("--resume", "nowhere"), 2, "is not a run"),
        (("drive.mind", "Go", "--runs", "drive.mind"), 1, "cannot write a run under"),
    ],
)
def test_what_cannot_be_done_is_said(
    train: Call, project: Path, arguments: tuple[str, ...], code: int, said: str
) -> None:
    refused = train(*arguments)
    assert refused.code == code
    assert said in refused.err
    assert "Traceback" not in refused.err
    assert not (project / "drive.lock").exists()


def test_what_was_learnt_is_safe_where_it_cannot_be_kept(train: Call, project: Path) -> None:
    (project / "weights").write_text("in the way")
    options = ("drive.mind", "Go", "--seed", "1", "--generations", "1", "--runs", "the runs", "--json")
    failed = train(*options)
    assert (failed.code, failed.out) == (1, "")
    assert failed.err.splitlines()[-2].startswith("the weights of Go cannot be written: ")
    command = failed.err.splitlines()[-1].partition("then: mindc train ")[2]
    (project / "weights").unlink()
    kept = train(*shlex.split(command), "--json")
    assert (project / "weights" / f"{json.loads(kept.out)['weights']['Go']}.npy").exists()
    assert "after 1 generation, in" in kept.err


def test_what_a_procedure_prints_is_talk(train: Call, project: Path) -> None:
    (project / "say.py").write_text("print('begins')\ndef both(x):\n    print('turns')\n    return [x, x]\n")
    skill = "skill Say is procedure from say.both\n  reads bearing\n  drives left_wheel\n  drives right_wheel\n"
    said = MIND.replace("skill Drive", f"{skill}skill Drive").replace("influences Go", "influences Say")
    (project / "drive.mind").write_text(said)
    taught = train("drive.mind", "Drive", "--generations", "1", "--json")
    assert json.loads(taught.out)["skill"] == "Drive"
    assert {"begins", "turns"} <= set(taught.err.splitlines())


def test_ctrl_c_finishes_the_generation_and_the_run_goes_on_as_if_nothing_had_been(train: Call, project: Path) -> None:
    run = interrupted(project)
    comments = MIND.replace("master", "# a comment changes nothing\nmaster")
    (project / "drive.mind").write_text(comments.replace("Go is mlp hidden 1", "Go is mlp hidden 2"))
    refused = train("--resume", run)
    assert refused.code == 1
    assert "has changed since this run of Go began" in refused.err
    (project / "drive.mind").write_text(comments)
    found = json.loads(train(*LONG).out)["weights"]
    assert [str(folder) for folder in (project / "runs" / "Go-on-Reach").iterdir()] == [run]
    once_more = train("--resume", run)
    assert (once_more.code, "has finished already" in once_more.err) == (0, True)
    train(*LONG, "--generations", "1")
    assert len(list((project / "runs" / "Go-on-Reach").iterdir())) == 2
    assert json.loads(train(*LONG, "--runs", "undisturbed").out)["weights"] == found


def test_a_scale_multiplies_the_generations(train: Call, project: Path) -> None:
    taught = train("drive.mind", "--scale", "1.5", "--json", "--seed", "1")
    assert [json.loads(line)["generations"] for line in taught.out.splitlines()] == [4, 3]


def interrupted(project: Path) -> str:
    """A run stopped with Ctrl-C."""
    command = [*TRAIN, *LONG]
    with subprocess.Popen(command, cwd=project, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        logs = project.glob("runs/Go-on-Reach/*/progress.jsonl")
        while process.poll() is None and not any(
            log.stat().st_size for log in project.glob("runs/Go-on-Reach/*/progress.jsonl")
        ):
            sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, talk = process.communicate()
    assert process.returncode == 130
    run = str(next(logs).parent)
    assert f"mindc train --resume {run.removeprefix(f'{project}/')}" in talk
    return run


def test_files_are_called_as_they_are_from_here(train: Call, project: Path) -> None:
    source = project / "drive.mind"
    source.write_text(MIND.replace("skill Go is mlp hidden 1\n", "skill Go is mlp hidden 1\n  stays frozen\n"))
    frozen = train("drive.mind", "Go")
    assert frozen.err.splitlines()[-1] == "  mindc edit unfreeze drive.mind Go --write"
    source.write_text(MIND)
    assert train("drive.mind", "Drive").err.splitlines()[-1].strip() == "first: mindc train drive.mind Go"


def test_attempts_are_told_apart(train: Call, project: Path) -> None:
    done = train("drive.mind", "Go", "--seed", "1", "--attempts", "2")
    assert done.code == 0, done.err
    for attempt, generation in (1, 1), (2, 3):
        where = rf"Go-on-Reach: attempt {attempt} of 2, generation {generation} of 3( and \d ahead)?, best "
        assert re.search(where, done.err), done.err
