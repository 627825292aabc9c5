"""What a robot's loop notices of being seen: python benchmarks/live_view.py [--rounds 3] [--ticks 900] [--json].

The same dry run of Collect at real time, in turns: recorded alone; with `--view`; with a page elsewhere, of which only
the questions are here; with a page in a Chromium on this machine (where there is none: without). Late is how long after
its time a tick began; pictures are the different ticks that the page has drawn, or whose rows have come, in a second;
row µs is what the loop's recorder takes for a row, handed out each second, or at once. Where others use the machine
the simulated wheels may be too slow for the guardian, which ends a run: then it has fewer ticks.
"""

import argparse
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, sleep
from typing import Any

import numpy as np
from mindrun.graph.bundle import read_bundle
from mindrun.graph.named_readings import physical
from mindrun.robot.recording import About, Recorder, read
from numpy.typing import NDArray
from websockets.sync.client import connect
from websockets.typing import Origin

COLLECT = Path(__file__).parents[1] / "examples" / "collect" / "collect.mind"
MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
MINDRUN = (sys.executable, "-m", "mindrun")
SITUATIONS = ("recorded alone", "--view", "page elsewhere", "page here")
MILLISECONDS_OF_TICK = 8  # in which it is counted what is seen
CLOCK_TICKS = 0.01  # by which the first tick may have been later than those after it
PICTURES = """milliseconds => new Promise((done) => {
  let [frames, drawn, last] = [0, 0, ""];
  const begin = performance.now();
  const count = (now) => {
    frames++;
    drawn += document.body.dataset.tick !== last;
    last = document.body.dataset.tick;
    if (now - begin < milliseconds) requestAnimationFrame(count);
    else done([frames, drawn].map((times) => (1000 * times) / (now - begin)));
  };
  requestAnimationFrame(count);
})"""


def pictures(address: str, milliseconds: int) -> tuple[float, float]:
    """Frames, and different ticks drawn, in a second of the page at an address."""
    from tests.view.browser import Opened, chromium

    with chromium() as browser:
        page = Opened(browser, address).page
        page.wait_for_timeout(1000)
        frames, drawn = page.evaluate(PICTURES, milliseconds)
    return frames, drawn


def questions(address: str, milliseconds: int) -> tuple[float, float]:
    """What a page at an address asks for: each newest row. No frames, and how many rows have come in a second."""
    page, _, token = address.partition("#")
    origin = Origin(page.rstrip("/"))
    rows, end = 0, perf_counter() + milliseconds / 1e3
    with connect(f"ws{page.removeprefix('http')}rows", origin=origin, compression=None, max_size=None) as connection:
        connection.send(token)
        while perf_counter() < end:
            said = connection.recv()
            if isinstance(said, bytes):
                rows += 1
            elif (message := json.loads(said))["say"] == "ticks":
                asked = {"say": "rows", "from": message["known"], "to": message["known"] + 1}
                connection.send(json.dumps(asked))
    return 0.0, 1e3 * rows / milliseconds


SEEN: dict[str, Callable[[str, int], tuple[float, float]]] = {"page elsewhere": questions, "page here": pictures}


def lateness(times: NDArray[np.float64], tick: float) -> tuple[NDArray[np.float64], int]:
    """How late each tick has begun, in milliseconds, and how many were missed, as `robot/rate.py` counts them."""
    since = times - times[0]
    due = np.floor(since / tick + CLOCK_TICKS)
    return np.maximum(0.0, since - due * tick) * 1e3, int(due[-1]) + 1 - len(times)


def driven(bundle: Path, day: Path, situation: str, ticks: int) -> tuple[NDArray[np.float64], int, list[float]]:
    """A run; how late its ticks were, how many it missed, and what its page has drawn."""
    words = [*MINDRUN, str(bundle), "--dry", "--arm", "--ticks", str(ticks), "--record", str(day)]
    words += ["--view"] * (situation != SITUATIONS[0])
    drawn: list[float] = []
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr
        for line in process.stderr:
            if situation in SEEN and (address := re.search(r"http://127\S+", line)):
                see = [sys.executable, __file__, "--see", situation, address[0], str(ticks * MILLISECONDS_OF_TICK)]
                browser = subprocess.run(see, capture_output=True, text=True, check=False, start_new_session=True)
                with suppress(ValueError):  # there is none, or the run has ended
                    drawn = json.loads(browser.stdout)
    about, parts = read(day)
    late, missed = lateness(np.concatenate([rows["time"] for rows in parts]), about.tick)
    return late, missed, drawn


def row_microseconds(bundle: Path, day: Path, rows: int) -> float:
    """The median time that the loop gives away for a row, at the rate of its ticks."""
    graph = read_bundle(bundle).graph
    about = About.of(graph, "0" * 64, graph.master, tuple(physical(graph)))
    row = {"readings": np.ones(graph.width), "influence": np.ones(len(graph.skills)), "stopped": 0, "armed": 1}
    taken = []
    with Recorder(day, about) as recorder:
        for tick in range(rows):
            sleep(graph.tick)
            begin = perf_counter()
            recorder.write(tick=tick, time=tick * graph.tick, **row)
            taken.append(perf_counter() - begin)
    return float(np.median(taken)) * 1e6


def measured(rounds: int, ticks: int) -> list[dict[str, Any]]:
    """A row for each situation."""
    found: dict[str, list[tuple[NDArray[np.float64], int, list[float]]]] = {name: [] for name in SITUATIONS}
    with TemporaryDirectory() as folder:
        bundle = Path(folder) / "collect.bundle"
        subprocess.run([*MINDC, "build", str(COLLECT), "-o", str(bundle), "-q"], check=True)
        for number in range(rounds):
            for place, name in enumerate(SITUATIONS):
                found[name].append(driven(bundle, Path(folder) / f"{number}-{place}.rec", name, ticks))
        cost = row_microseconds(bundle, Path(folder) / "rows.rec", ticks)
    rows = [summed(name, runs) for name, runs in found.items()]
    return [row | {"row µs": cost} for row in rows]


def summed(name: str, runs: list[tuple[NDArray[np.float64], int, list[float]]]) -> dict[str, Any]:
    """The figures of all runs of a situation."""
    late = np.concatenate([run[0] for run in runs])
    row: dict[str, Any] = {"loop": name, "ticks": len(late), "missed": sum(run[1] for run in runs)}
    row |= {"late ms": np.median(late), "99 % ms": np.quantile(late, 0.99), "worst ms": late.max()}
    seen = np.array([run[2] for run in runs if run[2]])
    middle = np.median(seen, axis=0).tolist() if len(seen) else [None, None]
    return row | {"frames/s": middle[0], "pictures/s": middle[1]}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--ticks", type=int, default=900)
    parser.add_argument("--see", nargs=3, help=argparse.SUPPRESS)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.see:
        situation, address, milliseconds = options.see
        print(json.dumps(SEEN[situation](address, int(milliseconds))))
        return
    rows = measured(options.rounds, options.ticks)
    if options.json:
        print(json.dumps(rows))
        return
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
    for row in [{name: name for name in rows[0]}, *rows]:
        print("  ".join(f"{_shown(value):>{20 if name == 'loop' else 10}}" for name, value in row.items()))


def _shown(value: object) -> str:
    return "" if value is None else f"{value:,.2f}" if isinstance(value, float) else f"{value}"


if __name__ == "__main__":
    main()
