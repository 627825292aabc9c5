"""Write what this version writes: locks, weights, bundles, a recording, and what the minds command for some readings.

    python -m tests.formats.write

For the version that is to be released, and never again for one that has been.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical, vector

import mindlang
from tests.formats import FOLDER, MINDS

VERSION = "0.1.0"
TICKS, RECORDED_TICKS, SEED = 24, 40, 3
FAILED_TICK = 7  # in which the first sensor reads NaN
MINDC = [sys.executable, "-c", "from mindlang.cli import main; main()"]
MINDRUN = [sys.executable, "-m", "mindrun"]


def run(*words: object, cwd: Path) -> str:
    """What a program that must succeed prints."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=cwd)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def commands(engine: Engine, readings: Path) -> str:
    """What a mind commands for readings, a line each, with the influence of each skill: as `mindrun --influence`."""
    names = [actuator.name for actuator in engine.graph.actuators]
    skills = [skill.name for skill in engine.graph.skills]
    lines = []
    for text in readings.read_text(encoding="utf-8").splitlines():
        sent = engine.tick(vector(engine.graph, json.loads(text)))
        line = {
            "commands": dict(zip(names, sent.tolist(), strict=True)),
            "influence": dict(zip(skills, engine.influence.tolist(), strict=True)),
        }
        lines.append(f"{json.dumps(line)}\n")
    return "".join(lines)


def _readings(graph: Graph) -> str:
    """A line of readings for each tick."""
    sensors, draw = physical(graph), np.random.default_rng(SEED)
    lines = [{name: draw.integers(0, 1001, each.width) / 1000 for name, each in sensors.items()} for _ in range(TICKS)]
    plain = [{name: values.tolist() for name, values in line.items()} for line in lines]
    plain[FAILED_TICK][next(iter(sensors))][0] = float("nan")
    return "".join(f"{json.dumps(line)}\n" for line in plain)


def write(folder: Path) -> None:
    """All files of a folder that has the minds and robot.yaml."""
    with TemporaryDirectory() as runs:
        run(*MINDC, "train", "rover.mind", "--seed", 1, "--runs", runs, cwd=folder)
        (log,) = Path(runs).glob("Fetch/*/progress.csv")
        shutil.copy(log, folder / "progress.csv")
    for name in MINDS:
        wired = ["--robot", "robot.yaml"] if name == "rover" else []
        run(*MINDC, "build", f"{name}.mind", *wired, "-o", f"{name}.bundle", cwd=folder)
        mind, readings = mindlang.load(folder / f"{name}.mind"), folder / f"{name}.readings.jsonl"
        readings.write_text(_readings(mind.graph), encoding="utf-8")
        (folder / f"{name}.commands.jsonl").write_text(commands(mind.engine(), readings), encoding="utf-8")
    (folder / "rover.rec").unlink(missing_ok=True)
    options = ["--record", "rover.rec", "--ticks", RECORDED_TICKS, "--task", "Roam", "--seed", SEED]
    run(*MINDRUN, "rover.bundle", "--dry", "--arm", "--quiet", *options, cwd=folder)


if __name__ == "__main__":
    write(FOLDER / VERSION)
