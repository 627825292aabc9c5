"""Training killed at random moments and gone on with, until so many kills: python benchmarks/kills.py [--kills 1000].

Every training that comes to its end must have the same lock, byte for byte, and so the same weights; after every kill
the lock and what it names must be whole. `--log FILE` has a line for each kill and each end: with it the campaign
itself can be stopped, and goes on. Children are forked from a process that has everything loaded, and save after 10 ms
rather than 2 s, so that more kills meet a checkpoint.
"""

import argparse
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # threads do not survive a fork
sys.path.insert(0, str(Path(__file__).parents[1]))

from mindrun.train.progress import read_progress
from mindrun.train.training import Watch

from mindlang import cli
from mindlang.cli import _trainer as trainer
from mindlang.lock import read_lock
from tests.train.test_train_command import MIND

LESSONS = ("Go", "Drive")
OPTIONS = ("--seed", "3", "--scale", "10", "--workers", "1")
CHECKPOINT_SECONDS = 0.01  # seconds between two checkpoints
MAX_KILL_SECONDS = 0.6  # of a training: the latest moment of a kill

Event = dict[str, Any]


def main() -> None:
    """Kill, and say what came of it; 1 where two trainings ended differently or anything was not whole."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--kills", type=int, default=1000, help="how many (default 1000)")
    parser.add_argument("--log", type=Path, help="a file that the campaign is written to, and goes on from")
    options = parser.parse_args()
    vars(trainer)["Watch"] = partial(Watch, save_every=CHECKPOINT_SECONDS)
    known = [json.loads(line) for line in options.log.read_text().splitlines()] if reads(options.log) else []
    with tempfile.TemporaryDirectory(prefix="mind-kills-") as name:
        seconds = undisturbed(Path(name) / "undisturbed")
        events = campaign(Path(name) / "disturbed", options.kills, seconds, known, options.log)
    locks = Counter(event["lock"] for event in events if event["what"] == "end")
    met = Counter(event["met"] for event in events if event["what"] == "kill")
    print(json.dumps({"kills": met.total(), "met": met, "trainings": locks.total(), "locks": locks}, indent=2))
    sys.exit(len(locks) != 1)


def reads(log: Path | None) -> bool:
    """Whether a campaign has begun already."""
    return log is not None and log.exists()


def undisturbed(project: Path) -> float:
    """Train once in this process, which loads what is compiled; then in a child, as the others: its seconds."""
    begun(project)
    here = Path.cwd()
    os.chdir(project)
    assert teach("train", "drive.mind", *OPTIONS, "-q") == 0
    os.chdir(here)
    begun(project)
    start = time.monotonic()
    assert finish(child(project)) == 0
    return time.monotonic() - start


def campaign(project: Path, kills: int, seconds: float, known: list[Event], log: Path | None) -> list[Event]:
    """Train and kill, until there are so many kills and the last training has ended; all that happened."""
    events, draw = list(known), random.Random(len(known))
    done = sum(event["what"] == "kill" for event in known)
    begun(project)
    while done < kills or (project / "runs").exists():
        moment = draw.uniform(0, MAX_KILL_SECONDS * seconds) if done < kills else None
        event = disturbed(project, moment)
        events.append(event)
        done += event["what"] == "kill"
        if log:
            with log.open("a") as file:
                file.write(json.dumps(event) + "\n")
        if event["what"] == "end":
            begun(project)
    return events


def begun(project: Path) -> None:
    """A project in which nothing was taught."""
    shutil.rmtree(project, ignore_errors=True)
    project.mkdir()
    (project / "drive.mind").write_text(MIND)


def disturbed(project: Path, moment: float | None) -> Event:
    """Train until the end, or until a moment; which of them it was, and what there is then, which must be whole."""
    process = child(project)
    if moment is not None:
        time.sleep(moment)
        os.kill(process, signal.SIGKILL)
    code = finish(process)
    taught = whole(project)
    if code == -signal.SIGKILL:
        return {"what": "kill", "moment": moment, "met": standing(project, taught)}
    if code or taught != set(LESSONS):
        sys.exit(f"a training ended with {code} and {taught}:\n{(project / 'said').read_text()}")
    return {"what": "end", "lock": sha256((project / "drive.lock").read_bytes()).hexdigest()}


def child(project: Path) -> int:
    """Train in a process of its own."""
    if process := os.fork():
        return process
    os.chdir(project)
    said = os.open("said", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    for stream in (1, 2):
        os.dup2(said, stream)
    code = teach("train", "drive.mind", *OPTIONS)
    sys.stdout.flush()
    os._exit(code)


def teach(*words: str) -> int:
    """Call mindc in this process; its exit code."""
    sys.argv = ["mindc", *words]
    try:
        cli.main()
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else 1
    return 0


def finish(process: int) -> int:
    """Wait for a process; its exit code, or minus the signal that ended it."""
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def whole(project: Path) -> set[str]:
    """The skills in the lock, which can be read, and whose weights are there and are those."""
    lock = read_lock(project / "drive.lock")
    for entry in lock.values():
        data = (project / "weights" / f"{entry.weights}.npy").read_bytes()
        assert sha256(data).hexdigest() == entry.weights, entry
    return set(lock)


def standing(project: Path, taught: set[str]) -> str:
    """What a kill met, in words."""
    runs = [path.parent for path in (project / "runs").glob("*/*/manifest.json")]
    if len(runs) <= len(taught):
        return "before a lesson was begun"
    newest = max(runs, key=lambda folder: folder.stat().st_mtime_ns)
    if (newest / "weights.npy").exists():
        return "taught and not yet in the lock"
    return "while it was taught" if read_progress(newest) else "before the first generation"


if __name__ == "__main__":
    main()
