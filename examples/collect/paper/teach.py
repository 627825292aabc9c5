"""The whole protocol from nothing, at any scale: python examples/collect/paper/teach.py --attempts 10 --scale 0.1.

Says how long it will take, copies the .mind files to --out, and teaches every lesson that has not been taught there. It
may be stopped at any time: the same command goes on where it stood. Then: make paper FOLDER=OUT.
"""

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path
from shutil import copyfile
from time import perf_counter

from logs import Log, keep, logs_of
from measure import compiled, rollout_of
from mindrun.errors import MindError
from mindrun.graph.graph import Lesson
from mindrun.processors import cores
from mindrun.terminal.arguments import MAX_SEED, real, whole
from mindrun.train.lesson_state import heights
from plan import Plan, keep_plan, read_plan
from protocol import FILES, FOLDER

from mindlang.cli._session import ensure_compiled
from mindlang.cli._trainer import Trainer
from mindlang.number_format import duration
from mindlang.run.setup import layouts

RUN_COUNT = 128  # of shipped champions, to see how fast this machine is; fewer would leave lanes empty


def main() -> None:
    """Say how long it takes, and do it."""
    options = arguments().parse_args()
    files = tuple(options.files) or FILES
    others = options.others or options.attempts
    plan = Plan(options.attempts, others, options.scale, options.population, options.seed, options.rungs)
    try:
        refuse_other(plan, options.out)
        foretell(plan, files, options.workers)
        if not options.dry_run:
            prepare(plan, options.out)
            trainer = Trainer(options.workers, as_json=False, quiet=False)
            if not all(teach(trainer, options.out, file, plan) for file in files):
                sys.exit(130)
            print(f"the tables: make paper FOLDER={options.out}")
    except MindError as error:
        sys.exit(f"{error}. {error.hint}")


def arguments() -> argparse.ArgumentParser:
    """The command line."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("files", nargs="*", type=_known, metavar="FILE", help="only these, in this order")
    parser.add_argument("--attempts", type=whole(1, 10_000), default=10, help="attempts of the lessons of collect.mind")
    parser.add_argument("--others", type=whole(1, 10_000), help="attempts of all other lessons (default: as many)")
    parser.add_argument("--scale", type=real(0, 1000), default=1.0, help="times the paper's generations")
    parser.add_argument("--population", type=whole(4, 1_000_000), help="instead of the 100 genomes that the files say")
    parser.add_argument("--seed", type=whole(0, MAX_SEED), default=1)
    parser.add_argument(
        "--rungs", type=whole(0, 16), default=0, help="where attempts are compared and half of them end"
    )
    parser.add_argument("--workers", type=whole(1, 1024), default=cores(), help="cores to use (default: all)")
    parser.add_argument("--out", type=Path, default=Path("runs/paper"), help="where it is taught")
    parser.add_argument("--dry-run", action="store_true", help="only say how long it would take")
    return parser


def _known(file: str) -> str:
    if file not in FILES:
        raise argparse.ArgumentTypeError(f"{file} is none of {', '.join(FILES)}")
    return file


def refuse_other(plan: Plan, out: Path) -> None:
    """MindError where a folder was begun with another plan: its tables would mix the two."""
    if (begun := read_plan(out)) not in (None, plan):
        raise MindError(f"{out} was begun with {begun}", "Go on with that, or choose another folder with --out")


def prepare(plan: Plan, out: Path) -> None:
    """Make the folder in which a plan is taught."""
    out.mkdir(parents=True, exist_ok=True)
    for file in FILES:
        if not (out / file).exists():
            copyfile(FOLDER / file, out / file)
        elif (out / file).read_bytes() != (FOLDER / file).read_bytes():
            print(f"note: {out / file} differs from {FOLDER / file}, and is taught as it stands", flush=True)
    keep_plan(out, plan)


def teach(trainer: Trainer, out: Path, file: str, plan: Plan) -> bool:
    """Teach what is due in a file and keep the logs; False if it was interrupted."""
    runs = out / "runs" / Path(file).stem
    print(f"\n{file}", flush=True)
    try:
        return trainer.teach_file(out / file, [], None, plan.options(file), force=False, seed=plan.seed, runs=runs)
    finally:
        for run in sorted(runs.glob("*/*")):
            keep(run, out, file)


def foretell(plan: Plan, files: Iterable[str], workers: int) -> None:
    """Print how long each file will take here, by what the shipped runs took and how fast this machine is."""
    told = {file: seconds_for(plan, file, workers) for file in files}
    for file, seconds in told.items():
        print(f"{'unknown' if seconds is None else duration(seconds):>14}  {file}", flush=True)
    known = [seconds for seconds in told.values() if seconds is not None]
    less = "" if len(known) == len(told) else ", beside what is unknown because no log of it was shipped"
    on = f"on {workers} core{'s' * (workers > 1)}"
    print(f"{duration(sum(known)):>14}  in all {on}, less what has been taught already{less}\n", flush=True)


def seconds_for(plan: Plan, file: str, workers: int) -> float | None:
    """The time that the lessons of a file's first curriculum take; None where no run of one was shipped."""
    graph = compiled(FOLDER / file).graph
    assert graph is not None
    shipped = logs_of(FOLDER, file)
    lessons = [lesson for lesson in graph.lessons if lesson.curriculum == graph.lessons[0].curriculum]
    if not all(lesson.name in shipped for lesson in lessons):
        return None
    return sum(
        ticks(plan.applied(file, lesson), shipped[lesson.name]) / speed(file, lesson, shipped[lesson.name], workers)
        for lesson in lessons
    )


def ticks(lesson: Lesson, log: Log) -> float:
    """How many ticks a lesson takes if each genome takes as many as those of a log did."""
    learner = lesson.learner
    attempts = 1 + (learner.attempts - 1) * share(learner.rungs)
    genomes = lesson.generations * attempts * learner.population
    return float(genomes * log.result["ticks"] / (log.result["bred"] * log.result["population"]))


def share(rungs: int) -> float:
    """The share of its generations that an attempt makes, if it falls behind at each rung as often as not."""
    return sum(height * 0.5 ** (n + 1) for n, height in enumerate(heights(rungs))) + 0.5**rungs


def speed(file: str, lesson: Lesson, log: Log, workers: int) -> float:
    """Ticks a second of a lesson on this machine, with the champions that were shipped."""
    rollout = rollout_of(FOLDER, file, lesson, [*log.result["weights"]], workers)
    ensure_compiled(rollout, print)  # before the clock starts
    begin = perf_counter()
    scores = rollout.score(log.champions, layouts(1, -(-RUN_COUNT // len(log.champions))))
    return float(scores.ticks.sum()) / (perf_counter() - begin)


if __name__ == "__main__":
    main()
