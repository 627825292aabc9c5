"""Lifelong learning, measured: python -m benchmarks.lifelong [--seeds 5] [--ticks 60e6] [--agents hierarchy monolith].

Every agent learns eight tasks one after the other, with the same ticks for each. After each lesson all tasks run on
layouts that no training has seen. What comes of a lesson is kept in a folder, so that whoever is stopped goes on where
it was. The same numbers come of any number of workers.

    python -m benchmarks.lifelong                                  all agents, five seeds: 35 minutes of two cores
    python -m benchmarks.lifelong --ticks 1e6 --seeds 1 --lessons 2    a look at all of it
    python -m benchmarks.lifelong --first 101 --seeds 2 --lessons 2 --agents "anchored 0.01" "anchored 0.1"
    python -m benchmarks.lifelong --json lifelong.json --figure lifelong.svg --page docs/lifelong.md
"""

import argparse
import json
import os
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path

from mindrun.files.atomic_write import write
from mindrun.processors import cores

from benchmarks.lifelong.agents import AGENTS, CANDIDATES, TASKS, network_on
from benchmarks.lifelong.lives import live, read
from benchmarks.lifelong.report import numbers, page, table


def parsed() -> argparse.Namespace:
    """The arguments."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--agents", nargs="+", default=[*AGENTS], choices=[*AGENTS, *CANDIDATES], metavar="AGENT")
    parser.add_argument("--lessons", type=int, default=len(TASKS), choices=range(1, len(TASKS) + 1), metavar="1-8")
    parser.add_argument("--ticks", type=float, default=60e6, help="of a lesson, for every agent")
    parser.add_argument("--layouts", type=int, default=50, help="on which each task runs after each lesson")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--workers", type=int, default=cores(), help="lives at a time")
    parser.add_argument("--folder", type=Path, default=Path("runs/lifelong"), help="where lessons are kept")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all numbers there")
    parser.add_argument("--figure", type=Path, metavar="FILE", help="draw them there, as .svg or .png")
    parser.add_argument("--page", type=Path, metavar="FILE", help="write the tables into this page")
    return parser.parse_args()


def main() -> None:
    """Let them live, print, draw."""
    options = parsed()
    setup = {"ticks": options.ticks, "layouts": options.layouts, "tasks": TASKS}
    options.folder.mkdir(parents=True, exist_ok=True)
    written = options.folder / "setup.json"
    if written.exists() and json.loads(written.read_text(encoding="utf-8")) != json.loads(json.dumps(setup)):
        sys.exit(f"{options.folder} has lessons of other ticks or layouts: name another --folder")
    write(written, json.dumps(setup).encode())
    network_on(0)  # compiled once
    common = options.lessons, options.ticks, options.layouts, options.folder
    seeds = range(options.first, options.first + options.seeds)
    with ProcessPoolExecutor(options.workers, get_context("spawn")) as pool:
        lives = [pool.submit(live, name, seed, *common) for seed in seeds for name in options.agents]
        for done in as_completed(lives):
            print(done.result(), file=sys.stderr, flush=True)
    found = numbers(read(options.folder, options.agents, seeds), options.lessons, setup)
    print(table(found))
    if options.json:
        write(options.json, (json.dumps(found, indent=1) + "\n").encode())
    if options.figure:
        from benchmarks.lifelong.figure import figure
        from mindlang.pictures.curves import image

        write(options.figure, image(figure(found), options.figure.suffix))
    if options.page:
        picture = os.path.relpath(options.figure, options.page.parent) if options.figure else ""
        write(options.page, page(options.page.read_text(encoding="utf-8"), found, picture).encode())


if __name__ == "__main__":
    main()
