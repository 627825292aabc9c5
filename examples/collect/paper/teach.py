"""The whole protocol from nothing, at any scale: python examples/collect/paper/teach.py --attempts 10 --scale 0.1.

Copies the .mind files to --out, says how long it will take, and teaches every lesson that has not been taught there. It
may be stopped at any time: the same command goes on where it stood. Then: python examples/collect/paper --folder OUT.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from shutil import copyfile
from time import perf_counter

from logs import Log, keep, logs_of
from measure import compiled, read_champions
from mindrun.errors import MindError
from mindrun.graph import Lesson
from mindrun.sim.rollout import Rollout, cores
from mindrun.train.run_folder import read_result
from protocol import FILES, FOLDER

from mindlang.figures import duration
from mindlang.lock.ready import make_ready
from mindlang.run.stage import layouts
from mindlang.school import School
from mindlang.school.teaching import Wishes

LAYOUTS = 16  # on which a shipped champion runs, to see how fast this machine is


@dataclass(frozen=True, slots=True)
class Plan:
    """Which files are taught, in how many attempts each, by how much their generations are multiplied, by how many."""

    files: tuple[str, ...]
    attempts: int
    others: int
    scale: float
    population: int | None

    def wishes(self, file: str) -> Wishes:
        """What is asked of a file's lessons."""
        attempts = self.attempts if file == FILES[0] else self.others
        return Wishes(scale=self.scale, population=self.population, attempts=attempts)


def main() -> None:
    """Say how long it takes, and do it."""
    options = arguments().parse_args()
    others = options.others or options.attempts
    plan = Plan(tuple(options.files) or FILES, options.attempts, others, options.scale, options.population)
    options.out.mkdir(parents=True, exist_ok=True)
    for file in FILES:
        if not (options.out / file).exists():
            copyfile(FOLDER / file, options.out / file)
    foretell(plan)
    if options.dry_run:
        return
    school = School(options.workers, as_json=False, quiet=False)
    for file in plan.files:
        if not teach(school, options.out, file, plan.wishes(file), options.seed):
            sys.exit(130)


def arguments() -> argparse.ArgumentParser:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=_known, metavar="FILE", help="only these, in this order")
    parser.add_argument("--attempts", type=int, default=10, help="attempts of the lessons of collect.mind")
    parser.add_argument("--others", type=int, help="attempts of all other lessons (default: as many)")
    parser.add_argument("--scale", type=float, default=1.0, help="times the paper's generations")
    parser.add_argument("--population", type=int, help="instead of the 100 genomes that the files say")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=None, help="cores to use (default: all)")
    parser.add_argument("--out", type=Path, default=Path("runs/paper"), help="where it is taught")
    parser.add_argument("--dry-run", action="store_true", help="only say how long it would take")
    return parser


def _known(file: str) -> str:
    if file not in FILES:
        raise argparse.ArgumentTypeError(f"{file} is none of {', '.join(FILES)}")
    return file


def teach(school: School, out: Path, file: str, wishes: Wishes, seed: int) -> bool:
    """Teach what is due in a file and keep the logs; False if it was interrupted."""
    runs = out / "runs" / Path(file).stem
    print(f"\n{file}", flush=True)
    try:
        finished = school.teach_file(out / file, [], None, wishes, force=False, seed=seed, runs=runs)
    except MindError as error:
        sys.exit(f"{file}: {error}. {error.hint}")
    for run in sorted(runs.glob("*/*")):
        if read_result(run):
            keep(run, out, file)
    return finished


def foretell(plan: Plan) -> None:
    """Print how long each file will take here, by what the shipped runs took and how fast this machine is."""
    total = 0.0
    unknown = 0
    for file in plan.files:
        seconds = seconds_for(plan, file)
        total += seconds or 0.0
        unknown += seconds is None
        print(f"{'unknown' if seconds is None else duration(seconds):>14}  {file}", flush=True)
    more = f", and {unknown} files of which no run was shipped" if unknown else ""
    print(f"{duration(total):>14}  in all on {cores()} cores, less what has been taught already{more}", flush=True)


def seconds_for(plan: Plan, file: str) -> float | None:
    """The time that a file's own lessons take; None where no run of it was shipped."""
    shipped, wishes = logs_of(FOLDER, file), plan.wishes(file)
    if not shipped:
        return None
    graph = compiled(FOLDER / file).graph
    assert graph is not None
    first = graph.lessons[0].curriculum
    lessons = [lesson for lesson in graph.lessons if lesson.curriculum == first]
    return sum(
        _seconds(file, lesson, log, wishes)
        for lesson, log in ((lesson, shipped.get(lesson.name)) for lesson in lessons)
        if log
    )


def _seconds(file: str, lesson: Lesson, log: Log, wishes: Wishes) -> float:
    taken, wished = log.result, wishes.applied(lesson)
    per_genome = taken["ticks"] / (taken["generations"] * taken["attempts"] * taken["population"])
    genomes = wished.generations * wished.learner.attempts * wished.learner.population
    return float(per_genome * genomes) / speed(file, lesson, log)


def speed(file: str, lesson: Lesson, log: Log) -> float:
    """Ticks a second of a lesson on this machine, with the champions that were shipped."""
    found = compiled(FOLDER / file)
    assert found.graph is not None
    ready = make_ready(found.graph, found.sources, lesson.master)
    rollout = Rollout(ready.graph, ready.weights, lesson.task, lesson.master, learners_of(log), workers=cores())
    begin = perf_counter()
    scores = rollout.score(read_champions(log.champions), layouts(1, LAYOUTS))
    return float(scores.ticks.sum()) / (perf_counter() - begin)


def learners_of(log: Log) -> Sequence[str]:
    """The skills whose weights a champion of a log has, in its order."""
    return list(log.result["weights"])


if __name__ == "__main__":
    main()
