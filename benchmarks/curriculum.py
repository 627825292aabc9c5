"""From nothing to Collect: python -m benchmarks.curriculum [--seeds 5] [--file best.mind --curriculum Best --known].

Every seed teaches the whole curriculum with `mindc train` in a folder of its own, on all cores, and what it has learnt
runs on 200 layouts that the training has not seen. What was learnt before is forgotten; with `--known`, what
the files know that it uses is there. A seed fails where a lesson does not reach what it needs, and where what came of
it delivers too little, or drives for too little of the run. The first compilation is not counted; starting Python is.
"""

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from shutil import copy, copytree
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.learning import prepared
from benchmarks.workloads import COLLECT, collect
from mindlang.cli._terminal import FINDINGS
from mindlang.compiler.compile import load

UNSEEN_SEED = 20211121  # of the layouts that no training has seen
MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
LINE = "seed {seed:>3}: {seconds:5.0f} s, {objects:5.2f} ± {error:.2f} objects, {runtime:.1%} of the run"
FAILED = "seed {seed:>3}: {seconds:5.0f} s, {why}"


def learn(file: str, curriculum: str, seed: int, runs: int, is_known: bool) -> dict[str, Any]:
    """One seed: how long it took, and what came of it."""
    with TemporaryDirectory() as folder:
        for source in load(COLLECT.with_name(file)).sources:
            bring(Path(source.name), Path(folder), known=is_known and Path(source.name).name != file)
        begin = time.perf_counter()
        done = mindc(folder, "train", file, "--curriculum", curriculum, "--seed", str(seed), "--force")
        seconds = time.perf_counter() - begin
        if done.returncode:
            return {"seed": seed, "seconds": seconds, "why": done.stderr.strip()}
        lines = documents(done.stdout)
        bench = mindc(folder, "bench", file, "--task", "Collect", "--runs", str(runs), "--seed", str(UNSEEN_SEED))
        (found,) = documents(bench.stdout)
    return {
        "seed": seed,
        "seconds": seconds,
        "objects": found["count_mean"],
        "error": found["count_std"] / runs**0.5,
        "runtime": found["runtime_mean"],
        "lessons": {line["lesson"]: round(line["seconds"], 1) for line in lines},
    }


def bring(mind: Path, folder: Path, known: bool) -> None:
    """Copy a file into a folder and, where what was learnt there is known, its lock with the weights."""
    copy(mind, folder)
    lock = mind.with_suffix(".lock")
    if known and lock.exists():
        copy(lock, folder)
        copytree(mind.parent / "weights", folder / "weights", dirs_exist_ok=True)


def mindc(folder: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """A command that has ended: with 0, or because a lesson has failed, which is an answer, too."""
    done = subprocess.run([*MINDC, *arguments, "--json", "--quiet"], cwd=Path(folder), capture_output=True, text=True)
    if done.returncode not in (0, FINDINGS):
        sys.exit(done.stderr)
    return done


def documents(text: str) -> Sequence[dict[str, Any]]:
    """What a command says as JSON, one document after the other."""
    decoder, found, rest = json.JSONDecoder(), [], text.strip()
    while rest:
        document, end = decoder.raw_decode(rest)
        found.append(document)
        rest = rest[end:].strip()
    return found


def main() -> None:
    """Teach, try, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--file", default="quick.mind", help="one of the examples' folder collect/")
    parser.add_argument("--curriculum", default="Quick")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--at-least", type=float, default=4.63, help="objects from which a seed has succeeded")
    parser.add_argument("--of-the-run", type=float, default=0.0, help="the share of the run that it has to drive for")
    parser.add_argument("--known", action="store_true", help="begin with what is shipped of the files that it uses")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    graph, weights, _ = collect()
    prepared(graph, weights, "Collect", 1)
    runs = []
    for seed in range(options.first_seed, options.first_seed + options.seeds):
        runs.append(learn(options.file, options.curriculum, seed, options.runs, options.known))
        if not options.json:
            line = FAILED if "why" in runs[-1] else LINE
            print(line.format(**runs[-1]), runs[-1].get("lessons", ""), flush=True)
    taught = [run for run in runs if "why" not in run]
    succeeded = sum(run["objects"] >= options.at_least and run["runtime"] >= options.of_the_run for run in taught)
    longest = max(run["seconds"] for run in runs)
    if options.json:
        print(json.dumps({"succeeded": succeeded, "longest": longest, "runs": runs}))
    else:
        said = f"{options.at_least:g} objects" + f" in {options.of_the_run:.0%} of the run" * (options.of_the_run > 0)
        print(f"{succeeded} of {len(runs)} seeds reach {said}; the longest took {longest:.0f} s")


if __name__ == "__main__":
    main()
