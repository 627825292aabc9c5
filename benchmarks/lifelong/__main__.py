"""Lifelong learning, measured: python -m benchmarks.lifelong [--sequence hundred] [--seeds 5] [--agents monolith].

Every agent learns the tasks of a sequence one after the other, with the same ticks for each: the paper's eight, or a
hundred, which are drawn with the first seed. After lessons all tasks run on layouts that no training has seen. What
comes of a lesson is kept in a folder, so that whoever is stopped goes on where it was. The same numbers come of any
number of workers.

    python -m benchmarks.lifelong                                  all agents, five seeds: 35 minutes of two cores
    python -m benchmarks.lifelong --sequence hundred --seeds 1     a hundred lessons: 20 minutes of two cores
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

from benchmarks.lifelong.agents import AGENTS, ALONE, CANDIDATES
from benchmarks.lifelong.lives import live, read
from benchmarks.lifelong.report import numbers, page, tables
from benchmarks.lifelong.sequence import network_on
from benchmarks.lifelong.sequences import SEQUENCES, sequence


def parsed() -> argparse.Namespace:
    """The arguments."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sequence", default="eight", choices=SEQUENCES, help="of tasks")
    parser.add_argument("--agents", nargs="+", choices=[*AGENTS, *CANDIDATES], metavar="AGENT")
    parser.add_argument("--lessons", type=int, help="the first so many of them")
    parser.add_argument("--ticks", type=float, help="of a lesson, for every agent: 60e6 of eight, 8e6 of a hundred")
    parser.add_argument("--layouts", type=int, default=50, help="on which a task runs whenever it is tried")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--workers", type=int, default=cores(), help="lives at a time")
    parser.add_argument("--folder", type=Path, help="where lessons are kept: runs/lifelong, runs/hundred")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all numbers there")
    parser.add_argument("--figure", type=Path, metavar="FILE", help="draw eight lessons there, as .svg or .png")
    parser.add_argument("--page", type=Path, metavar="FILE", help="write the tables into this page")
    return parser.parse_args()


def main() -> None:
    """Let them live, print, draw."""
    options = parsed()
    is_default = options.sequence == "eight"
    of = sequence(drawn := (options.sequence, options.first))
    ticks, lessons = options.ticks or of.ticks, len(of.tasks)
    if options.lessons:  # and those until all tasks are tried
        lessons = min(-(-options.lessons // of.looks_apart) * of.looks_apart, lessons)
    agents = options.agents or [name for name in AGENTS if of.earlier or name != ALONE]
    folder = options.folder or Path("runs", "lifelong" if is_default else options.sequence)
    setup = {"ticks": ticks, "layouts": options.layouts, "tasks": of.tasks}
    folder.mkdir(parents=True, exist_ok=True)
    written = folder / "setup.json"
    if written.exists() and json.loads(written.read_text(encoding="utf-8")) != json.loads(json.dumps(setup)):
        sys.exit(f"{folder} has lessons of other tasks, ticks or layouts: name another --folder")
    write(written, json.dumps(setup).encode())
    network_on(of, 0)  # compiled once
    seeds = range(options.first, options.first + options.seeds)
    with ProcessPoolExecutor(options.workers, get_context("spawn")) as pool:
        common = drawn, lessons, ticks, options.layouts, folder
        lives = [pool.submit(live, name, seed, *common) for seed in seeds for name in agents]
        for done in as_completed(lives):
            print(done.result(), file=sys.stderr, flush=True)
    found = numbers(read(folder, agents, seeds), of, lessons, setup)
    print("\n\n".join(tables(found)))
    if options.json:
        write(options.json, (json.dumps(found) + "\n").encode())
    if options.figure:
        from benchmarks.lifelong.figure import figure
        from mindlang.pictures.curves import image

        write(options.figure, image(figure(found), options.figure.suffix))
    if options.page:
        picture = os.path.relpath(options.figure, options.page.parent) if options.figure else ""
        marked = "" if is_default else f" {options.sequence}"
        write(options.page, page(options.page.read_text(encoding="utf-8"), found, marked, picture).encode())


if __name__ == "__main__":
    main()
