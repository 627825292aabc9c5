"""How soon a run is seen, and how soon another tick of it.

    python benchmarks/view.py [--file FILE --task TASK] [--skills N] [--jumps N]

From the command to its address, to what the run is about, to its first rows; how fast all ticks come; then jumps to
random ticks, each a request for a single row with what every edge transmits, one after the other. The machine code has
to be in the cache (`mindc warmup`). Default: examples/collect, Collect, 500 jumps; with --skills a generated mind of
so many, that of benchmarks/view_frames.py.
"""

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from struct import Struct
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from benchmarks.view_frames import tree

MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
HEADER, ROWS_PLACE = Struct("<6I"), 4  # of an answer with rows: how many there are
FILE, TASK, JUMP_COUNT, FIRST_ROWS = "examples/collect/collect.mind", "Collect", 500, 256


@contextmanager
def viewing(file: str, task: str) -> Iterator[tuple[ClientConnection, float, str]]:
    """A viewer that has said its token, when the command was given, and how long its address took."""
    begin = perf_counter()
    command = [*MINDC, "view", file, "--task", task, "--seed", "3", "--no-interruption", "--no-browser", "-q"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            address, token = process.stdout.readline().strip().split("#")
            listening = f"{perf_counter() - begin:.2f} s ({cpu_seconds(process.pid):.2f} s of CPU time)"
            origin = Origin(address.rstrip("/"))
            with connect(f"ws{address.removeprefix('http')}rows", origin=origin, max_size=None) as connection:
                connection.send(token)
                yield connection, begin, listening
        finally:
            process.kill()


def cpu_seconds(process: int) -> float:
    """The CPU time that a process has taken so far: on a busy machine what it would take on one that is not."""
    user, system = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def said(connection: ClientConnection, says: str) -> dict[str, object]:
    """The next message that says this."""
    while True:
        found = connection.recv()
        if isinstance(found, str) and (message := json.loads(found))["say"] == says:
            return dict(message)


def rows(connection: ClientConnection, first: int, below: int) -> bytes:
    """The rows of these ticks."""
    connection.send(json.dumps({"say": "rows", "from": first, "to": below}))
    while isinstance(found := connection.recv(), str):
        pass
    return found


def run_to(connection: ClientConnection, tick: int) -> int:
    """Let the run go on; the last tick that is known then."""
    connection.send(json.dumps({"say": "run", "to": tick}))
    while not ((ticks := said(connection, "ticks"))["over"] or int(str(ticks["known"])) >= tick):
        pass
    return int(str(ticks["known"]))


def measure(file: str, task: str, jumps: int) -> None:
    """Measure and print."""
    with viewing(file, task) as (connection, begin, listening):
        about = said(connection, "about")
        told = perf_counter() - begin
        run_to(connection, FIRST_ROWS)
        came = HEADER.unpack_from(rows(connection, 0, FIRST_ROWS))[ROWS_PLACE]  # of many edges not all at once
        first = perf_counter() - begin
        print(f"address {listening}, about {told:.2f} s, first {came} rows {first:.2f} s after the command")
        begin = perf_counter()
        known = run_to(connection, int(str(about["of_ticks"])))
        print(f"{known:,} ticks known after {perf_counter() - begin:.2f} s")
        seconds = []
        for tick in np.random.default_rng(1).integers(0, known + 1, jumps).tolist():
            begin = perf_counter()
            rows(connection, tick, tick + 1)
            seconds.append(perf_counter() - begin)
        middle, worst = np.median(seconds) * 1000, max(seconds) * 1000
        print(f"{len(seconds)} jumps: {middle:.1f} ms in the middle, {worst:.1f} ms the slowest")
        print(f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def main() -> None:
    """Measure a file, or a mind that is generated."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--file", default=FILE)
    parser.add_argument("--task", default=TASK)
    parser.add_argument("--skills", type=int)
    parser.add_argument("--jumps", type=int, default=JUMP_COUNT)
    options = parser.parse_args()
    if options.skills is None:
        measure(options.file, options.task, options.jumps)
        return
    with TemporaryDirectory() as folder:
        path = Path(folder, "tree.mind")
        path.write_text(tree(options.skills), encoding="utf-8")
        measure(str(path), "Go", options.jumps)


if __name__ == "__main__":
    main()
