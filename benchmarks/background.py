"""The architectures of the paper's section 2 beside MIND, from nothing: python benchmarks/background.py --first 1.

Each of examples/background is taught with --seeds seeds from --first on, in one thread, in a folder of its own under
--out, and then tried in the same fresh runs. It may be stopped at any time: the same command goes on with what is left.
Every figure is a mean over seeds ± the standard error over seeds.
"""

import argparse
import json
import time
from functools import partial
from multiprocessing import Pool
from pathlib import Path
from shutil import copyfile, rmtree

import numpy as np
from mindrun.terminal.arguments import whole

import mindlang

FOLDER = Path(__file__).parents[1] / "examples" / "background"
NAMES = ("subsumption", "vectors", "switch", "winner", "layers", "coevolution", "mind")
TASK, EXAM = "Forage", "Exam"
HEAD = ("", "score", "gems", "collisions", "exams passed", "weights learnt", "ticks of training", "CPU")
Row = dict[str, float]


def main() -> None:
    """Teach and try what is left, and print the table."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=whole(2, 1000), default=5)
    parser.add_argument("--first", type=whole(0, 2**62), default=1, help="the first seed")
    parser.add_argument("--runs", type=whole(2, 1_000_000), default=400, help="fresh runs of each mind")
    parser.add_argument("--layouts", type=whole(0, 2**62), default=20261127, help="draws the fresh runs")
    parser.add_argument("--processes", type=whole(1, 1024), default=1, help="minds taught at a time")
    parser.add_argument("--out", type=Path, default=Path("runs/background"))
    options = parser.parse_args()
    seeds = range(options.first, options.first + options.seeds)
    jobs = [(name, seed) for seed in seeds for name in NAMES]
    with Pool(options.processes) as pool:
        found = dict(pool.imap(partial(row, options.out, options.runs, options.layouts), jobs))
    print(line(HEAD), "|" + "---|" * len(HEAD), sep="\n")
    for name in NAMES:
        print(line((name, *cells([found[name, seed] for seed in seeds]))))


def row(out: Path, runs: int, layouts: int, job: tuple[str, int]) -> tuple[tuple[str, int], Row]:
    """What came of a mind taught with a seed; read where it has been written down."""
    name, seed = job
    written = out / f"{name}-{seed}.json"
    if not written.exists():
        found = tried(out / f"{name}-{seed}", name, seed, runs, layouts)
        written.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
        print(f"{name} {seed}: {found['score']:.1f}", flush=True)
    return job, json.loads(written.read_text(encoding="utf-8"))


def tried(folder: Path, name: str, seed: int, runs: int, layouts: int) -> Row:
    """Teach all lessons of a mind in a folder, and try what it has learnt."""
    rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for source in FOLDER.glob("*.mind"):
        copyfile(source, folder / source.name)
    began = time.process_time()
    results = mindlang.load(folder / f"{name}.mind").train(seed=seed, runs=folder / "runs")
    seconds, mind = time.process_time() - began, mindlang.load(folder / f"{name}.mind")
    learners = sorted({skill for result in results for skill in result["weights"]})
    forage, exam = (mind.bench(task, runs, layouts) for task in (TASK, EXAM))
    return {
        "score": forage["score_mean"],
        "gems": forage["by_event"]["reach of gem"]["mean"],
        "collisions": forage["by_event"]["collision"]["mean"],
        "passed": 100 * exam["success"]["mean"],
        "weights": mind.rollout(TASK, mind.graph.master, learners).genome_length,
        "ticks": sum(result["ticks"] for result in results),
        "seconds": seconds,
    }


def cells(rows: list[Row]) -> tuple[str, ...]:
    """The cells of a mind in the table, of the rows of its seeds."""
    return (
        spread(rows, "score", 1),
        spread(rows, "gems", 2),
        spread(rows, "collisions", 2),
        f"{spread(rows, 'passed', 0)} %",
        f"{rows[0]['weights']:.0f}",
        f"{np.mean([each['ticks'] for each in rows]) / 1e6:.1f} M",
        f"{np.mean([each['seconds'] for each in rows]):.0f} s",
    )


def spread(rows: list[Row], figure: str, digits: int) -> str:
    """The mean of a figure over seeds, ± the standard error."""
    values = [each[figure] for each in rows]
    return f"{np.mean(values):.{digits}f} ± {np.std(values, ddof=1) / len(values) ** 0.5:.{digits}f}"


def line(texts: tuple[str, ...]) -> str:
    """A line of a table in Markdown."""
    return f"| {' | '.join(texts)} |"


if __name__ == "__main__":
    main()
