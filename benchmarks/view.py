"""How soon a run is seen, and how soon another tick of it.

    python benchmarks/view.py [FILE TASK [ticks asked for]]

From the command to its address, to what the run is about, to its first rows; how fast all ticks come; then jumps to
random ticks, each a request for a single row with what every edge transmits, one after the other. The machine code has
to be in the cache (`mindc warmup`). Default: examples/collect, Collect, 500 jumps.
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter

import numpy as np
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
FILE, TASK, JUMP_COUNT, FIRST_ROWS = "examples/collect/collect.mind", "Collect", 500, 256


@contextmanager
def viewing(file: str, task: str) -> Iterator[tuple[ClientConnection, float, float]]:
    """A viewer that has said its token, when the command was given, and the seconds until its address was there."""
    begin = perf_counter()
    command = [*MINDC, "view", file, "--task", task, "--seed", "3", "--no-interruption", "--no-browser", "-q"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            address, token = process.stdout.readline().strip().split("#")
            listening = perf_counter() - begin
            origin = Origin(address.rstrip("/"))
            with connect(f"ws{address.removeprefix('http')}rows", origin=origin, max_size=None) as connection:
                connection.send(token)
                yield connection, begin, listening
        finally:
            process.kill()


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


def main(file: str = FILE, task: str = TASK, jumps: str = str(JUMP_COUNT)) -> None:
    """Measure and print."""
    with viewing(file, task) as (connection, begin, listening):
        about = said(connection, "about")
        told = perf_counter() - begin
        run_to(connection, FIRST_ROWS)
        rows(connection, 0, FIRST_ROWS)
        first = perf_counter() - begin
        print(f"address {listening:.2f} s, about {told:.2f} s, first {FIRST_ROWS} rows {first:.2f} s after the command")
        begin = perf_counter()
        known = run_to(connection, int(str(about["of_ticks"])))
        print(f"{known:,} ticks known after {perf_counter() - begin:.2f} s")
        seconds = []
        for tick in np.random.default_rng(1).integers(0, known + 1, int(jumps)).tolist():
            begin = perf_counter()
            rows(connection, tick, tick + 1)
            seconds.append(perf_counter() - begin)
        middle, worst = np.median(seconds) * 1000, max(seconds) * 1000
        print(f"{len(seconds)} jumps: {middle:.1f} ms in the middle, {worst:.1f} ms the slowest")


if __name__ == "__main__":
    main(*sys.argv[1:])
