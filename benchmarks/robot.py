"""A tick of ball.mind, recorded ticks computed again, the start of mindrun: python benchmarks/robot.py [--json]."""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.bundle import read_bundle
from mindrun.robot.recording import About, Recorder, read
from mindrun.robot.replay import replay

BALL = Path(__file__).parents[1] / "examples" / "collect" / "ball.mind"
TICK_COUNT, START_COUNT = 20_000, 9


def bundle_of(mind: Path, folder: Path) -> Path:
    """The mind's bundle."""
    path = folder / "ball.bundle"
    program = "from mindlang.cli import main; main()"
    subprocess.run([sys.executable, "-c", program, "build", mind, "-o", path, "-q"], check=True)
    return path


def tick(path: Path) -> float:
    """Microseconds of one tick of the engine."""
    bundle = read_bundle(path)
    engine = ChangedEngine(bundle.policy, bundle.procedures)
    readings = np.random.default_rng(1).random((1000, bundle.graph.width), np.float32)
    times = []
    for _ in range(7):
        begin = time.perf_counter()
        for row in readings:
            engine.tick(row)
        times.append((time.perf_counter() - begin) / len(readings))
    return median(times) * 1e6


def replayed(path: Path, folder: Path, ticks: int) -> tuple[float, float, bool]:
    """Seconds to read so many recorded ticks, and to compute them again, and whether all are the same."""
    bundle = read_bundle(path)
    engine = ChangedEngine(bundle.policy, bundle.procedures)
    readings = np.random.default_rng(2).random((ticks, bundle.graph.width), np.float32)
    day = folder / "day.rec"
    with Recorder(day, About.of(bundle.graph, "0" * 64, bundle.graph.master, ("proximity",))) as recorder:
        for number, row in enumerate(readings):
            commands = engine.tick(row)
            recorder.write(tick=number, readings=row, influence=engine.influence, commands=commands, sent=commands)
    begin = time.perf_counter()
    sum(map(len, read(day)[1]))
    is_read = time.perf_counter()
    found = replay(day, "0" * 64, engine)
    return is_read - begin, time.perf_counter() - is_read, found.differs is None and found.ticks == ticks


def start(path: Path) -> float:
    """Seconds until mindrun has read a bundle and said what it holds."""
    times = []
    for _ in range(START_COUNT):
        begin = time.perf_counter()
        subprocess.run([sys.executable, "-m", "mindrun", path, "--describe"], check=True, stdout=subprocess.DEVNULL)
        times.append(time.perf_counter() - begin)
    return median(times)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--ticks", type=int, default=TICK_COUNT, help="to record and replay (the issue: 1000000)")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        path = bundle_of(BALL, Path(folder))
        reading, seconds, same = replayed(path, Path(folder), options.ticks)
        found = {"tick µs": tick(path), "replayed": options.ticks, "read s": reading, "replay s": seconds, "same": same}
        found["start s"] = start(path)
    if options.json:
        print(json.dumps(found))
        return
    for name, value in found.items():
        print(f"{name:>10}  {value:,.3g}" if isinstance(value, float) else f"{name:>10}  {value:,}")


if __name__ == "__main__":
    main()
