"""`mindc train --on`: the same weights wherever they are taught, and one sentence where they cannot be."""

import json
import signal
import subprocess
import sys
from io import StringIO
from pathlib import Path
from time import sleep

import pytest

from tests.calling import Call
from tests.train.test_train_command import LONG, MIND

TAUGHT = ("drive.mind", "Go", "--seed", "3", "--generations", "6", "--attempts", "3", "--from-scratch", "--json")

TIMES = "seconds", "ticks_per_second", "cpu_seconds", "ticks_per_cpu_second", "workers", "on"
RUN = "runs/Go-on-Reach/*"


def weights(mindc: Call, folder: Path, *words: str) -> dict[str, str]:
    folder.mkdir()
    (folder / "drive.mind").write_text(MIND)
    done = mindc("train", folder / "drive.mind", *TAUGHT[1:], "--runs", folder / "runs", *words)
    assert done.code == 0, done.err
    found: dict[str, str] = json.loads(done.out)["weights"]
    return found


def test_the_weights_are_the_same_on_threads_and_on_workers(mindc: Call, tmp_path: Path) -> None:
    expected = weights(mindc, tmp_path / "one after the other", "--workers", "1")
    assert weights(mindc, tmp_path / "threads", "--on", "threads", "--workers", "2") == expected
    assert weights(mindc, tmp_path / "processes", "--on", "processes:2") == expected


def test_of_a_single_attempt_the_runs_are_the_jobs(mindc: Call, tmp_path: Path) -> None:
    expected = weights(mindc, tmp_path / "threads", "--attempts", "1")
    assert weights(mindc, tmp_path / "processes", "--attempts", "1", "--on", "processes:2") == expected


def test_many_runs_are_the_same_wherever_they_are_made(mindc: Call, drive: Path) -> None:
    assert mindc("train", drive, "Go", "Drive", "--seed", "3", "-q").code == 0
    for words in (("--no-interruption", "--master", "Drive"), (drive, "--master", "Go", "--master", "Drive")):
        found = []
        for on in ((), ("--on", "processes:1")):
            done = mindc("bench", drive, *words, "--task", "Reach", "--runs", 90, "--csv", "runs.csv", "--json", *on)
            assert done.code == 0, done.err
            found.append((timeless(json.loads(done.out)), Path("runs.csv").read_bytes()))
        assert found[0] == found[1]


def test_a_procedure_that_prints_and_reads_takes_no_answer_and_no_job(
    mindc: Call, drive: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rule = "skill Go is procedure from talk.go\n  reads bearing\n  drives left_wheel\n  drives right_wheel\n"
    text = MIND[: MIND.index("skill Go")] + rule + MIND[MIND.index("skill Drive") : MIND.index("curriculum School")]
    text = text[: text.index("skill Drive")] + text[text.index("task Reach") :]
    drive.write_text(text.replace("master Drive", "master Go"))
    monkeypatch.setattr(sys, "stdin", StringIO())
    drive.with_name("talk.py").write_text(
        "import os, sys\n\n\ndef go(bearing):\n    print('mindfrm1', bearing)\n    os.write(1, b'mindfrm1')\n"
        "    assert sys.stdin.read() == ''\n    return bearing, 0.7\n"
    )
    found = []
    for on in ((), ("--on", "processes:2")):
        done = mindc("bench", drive, "--task", "Reach", "--runs", "9", "--csv", "runs.csv", *on)
        assert done.code == 0, done.err
        found.append(Path("runs.csv").read_bytes())
    assert found[0] == found[1]


def timeless(value: object) -> object:
    """What is said of runs but for how fast they were made, and by whom."""
    if isinstance(value, dict):
        return {k: timeless(each) for k, each in value.items() if k not in TIMES}
    return [timeless(each) for each in value] if isinstance(value, list) else value


@pytest.mark.parametrize(
    ("where", "words"),
    [
        ("moon", "nobody knows where 'moon' is"),
        ("processes:0", "it is not from 1 to 1024"),
        ("processes:many", "it is no whole number"),
        ("ssh:", "a machine has no name"),
        ("ssh:a,-oProxyCommand=x", "is no machine"),
        ("ssh:a:no python", "is no machine"),
        ("slurm:0", "is no number of jobs from 1 to 10000"),
        ("slurm:8,nodes=2", "says none of cores, memory, queue, account, walltime"),
        ("slurm:8,cores=many", "is no number of cores"),
        ("command:srun mindrun work", "any more; Dask begins workers now: --on ssh:a,b or --on slurm:8"),
    ],
)
def test_what_says_no_place_is_refused(mindc: Call, drive: Path, where: str, words: str) -> None:
    done = mindc("train", *TAUGHT, "--on", where)
    assert done.code == 2
    assert words in " ".join(done.err.split())
    assert not Path("runs").exists()


@pytest.mark.parametrize("where", [pytest.param(("--workers", "2"), marks=pytest.mark.slow), ("--on", "processes:2")])
@pytest.mark.parametrize("how", [signal.SIGINT, pytest.param(signal.SIGKILL, marks=pytest.mark.slow)])
def test_stopped_or_killed_it_goes_on_to_the_same_weights_there_or_here(
    mindc: Call, drive: Path, where: tuple[str, ...], how: signal.Signals
) -> None:
    words = (*LONG, "--attempts", "3")
    command = [sys.executable, "-c", "from mindlang.cli import main; main()", "train", *words, *where]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and not any(log.stat().st_size for log in Path().glob(f"{RUN}/progress.jsonl")):
            sleep(0.005)
        process.send_signal(how)
        _, talk = process.communicate()
    assert process.returncode == {signal.SIGINT: 130}.get(how, -how), talk
    if how == signal.SIGINT:
        assert "what workers are at is done again then; Ctrl-C again stops at once" in talk
    [run] = Path().glob(RUN)
    there = json.loads(mindc("train", *words, *where).out)
    undisturbed = json.loads(mindc("train", *words, "--workers", "1", "--runs", "undisturbed").out)
    assert (there["run"], there["weights"]) == (str(run), undisturbed["weights"])


@pytest.mark.slow
def test_event_files_have_every_generation_once_wherever_they_were_made(mindc: Call, tmp_path: Path) -> None:
    pytest.importorskip("tensorboardX", reason="event files are written with tensorboardX")
    weights(mindc, tmp_path / "here", "--tensorboard")
    weights(mindc, tmp_path / "there", "--tensorboard", "--on", "processes:2")
    here, there = (
        {path.parent.name: scores(path) for path in sorted((tmp_path / folder).glob(f"{RUN}/tensorboard/*/*"))}
        for folder in ("here", "there")
    )
    assert len(here) == 3
    assert here == there


def scores(path: Path) -> dict[str, dict[int, float]]:
    """What an event file says, but for times."""
    from tests.train.test_event_files import SPEED, read

    return {tag: steps for tag, steps in read(path).items() if tag != SPEED}


def test_who_types_mindrun_work_is_told_what_takes_its_place() -> None:
    done = subprocess.run([sys.executable, "-m", "mindrun", "work", "--threads", "1"], capture_output=True, check=False)
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"there is no mindrun work any more" in done.stderr
    assert b"dask worker --scheduler-file scheduler.json" in done.stderr
