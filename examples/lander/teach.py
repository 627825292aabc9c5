"""The hierarchy beside one perceptron of as many weights, from nothing: python examples/lander/teach.py --seeds 5.

Each seed is taught in one thread, into a folder under --out; the perceptron has as many steps as the hierarchy of its
seed took. Both fly the same fresh episodes. It may be stopped at any time: the same command goes on with what is left.
At the end the table is in --out as RESULTS.md.
"""

import argparse
import json
import os
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from shutil import copyfile, rmtree
from string import Template

import numpy as np
from mindrun.arguments import real, whole
from mindrun.graph import Lesson
from mindrun.sim.rollout import Rollout
from mindrun.train.attempt import judge
from mindrun.train.lesson import ended, teach
from mindrun.train.lesson_state import Course, begin
from mindrun.train.population import Genomes, Scores
from mindrun.train.training import best

import mindlang
from mindlang.run.layouts import layouts

FOLDER = Path(__file__).parent
SOLVED = 200  # a mean score with which the environment counts as solved
ENDLESS_GENERATIONS = 10**6
NO_GENOME = np.zeros((1, 0), np.float32)
FINISHER = "Brake-on-Land"  # the first lesson of the evolution strategy


@dataclass(frozen=True, slots=True)
class Outcome:
    """One seed of one mind: what it scores in fresh episodes, and what it took."""

    kind: str
    seed: int
    weights: int
    mean: float
    standard_error: float
    solved: float
    plain: float | None
    steps: tuple[int, int]
    seconds: float
    cpu_seconds: float
    load: float


@dataclass(frozen=True, slots=True)
class Plan:
    """Where seeds are taught, in times so many generations, and in how many fresh episodes they are tried."""

    out: Path
    runs: int
    episodes: int
    scale: float

    def path(self, kind: str, seed: int) -> Path:
        """Where the outcome of a seed lies."""
        return self.out / f"{kind}-{seed}.json"


def main() -> None:
    """Teach what is left, and write the tables."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=whole(1, 1000), default=5)
    parser.add_argument("--runs", type=whole(2, 1_000_000), default=1000, help="fresh episodes of each seed")
    parser.add_argument("--episodes", type=whole(0, 2**62), default=20261123, help="draws the fresh episodes")
    parser.add_argument("--scale", type=real(0, 1000), default=1.0, help="times the generations of lander.mind")
    parser.add_argument("--processes", type=whole(1, 1024), default=2, help="seeds at a time")
    parser.add_argument("--out", type=Path, default=Path("runs/lander"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    plan, seeds = Plan(options.out, options.runs, options.episodes, options.scale), range(1, options.seeds + 1)
    with ProcessPoolExecutor(options.processes, get_context("spawn")) as pool:
        for kind in TEACHERS:
            left = [seed for seed in seeds if not plan.path(kind, seed).exists()]
            for found in pool.map(partial(try_out, plan, kind), left):
                print(row(found), flush=True)
    outcomes = [read(plan, kind, seed) for kind in TEACHERS for seed in seeds]
    (options.out / "RESULTS.md").write_text(report(plan, outcomes), encoding="utf-8")


def try_out(plan: Plan, kind: str, seed: int) -> Outcome:
    """Teach a seed of a kind, try it, and write down what came of it."""
    found = TEACHERS[kind](plan, seed)
    path = plan.path(kind, seed)
    path.with_suffix(".part").write_text(json.dumps(asdict(found), indent=1) + "\n", encoding="utf-8")
    path.with_suffix(".part").replace(path)
    return found


def hierarchy(plan: Plan, seed: int) -> Outcome:
    """Teach all lessons of lander.mind."""
    folder = plan.out / f"seed-{seed}"
    rmtree(folder, ignore_errors=True)
    folder.mkdir()
    copyfile(FOLDER / "lander.mind", folder / "lander.mind")
    options = mindlang.TrainOptions(scale=plan.scale)
    began, cpu = time.perf_counter(), time.process_time()
    results = mindlang.load(folder / "lander.mind").train(options=options, seed=seed, runs=folder / "runs")
    took = time.perf_counter() - began, time.process_time() - cpu
    finishing = next(number for number, each in enumerate(results) if each["lesson"] == FINISHER)
    ticks = [int(each["ticks"]) for each in results]
    mind = mindlang.load(folder / "lander.mind")
    plain = scores(plan, mind.rollout("Land", "Approach"), NO_GENOME).mean()
    learners = sorted({skill for each in results for skill in each["weights"]})
    weights = mind.rollout("Land", "Land", learners).genome_length
    steps = sum(ticks[:finishing]), sum(ticks[finishing:])
    return outcome("hierarchy", seed, weights, scores(plan, mind.rollout("Land"), NO_GENOME), float(plain), steps, took)


def perceptron(plan: Plan, seed: int) -> Outcome:
    """Teach the lessons of monolith.mind, each learner in as many steps as it had in the hierarchy of this seed."""
    steps = read(plan, "hierarchy", seed).steps
    mind = mindlang.load(FOLDER / "monolith.mind")
    lessons = [lesson for lesson in mind.graph.lessons if lesson.skill == "Pilot"]
    rollout = mind.rollout("Land", "Pilot", ["Pilot"])
    rollout.compile()
    champion, taken = np.empty((0, rollout.genome_length), np.float32), []
    began, cpu = time.perf_counter(), time.process_time()
    for lesson, limit in zip(lessons, steps, strict=True):
        champion, ticks = taught(lesson, rollout, champion, seed, limit)
        taken.append(ticks)
    took = time.perf_counter() - began, time.process_time() - cpu
    found = scores(plan, rollout, champion)
    return outcome("mlp", seed, rollout.genome_length, found, None, (taken[0], taken[1]), took)


def taught(lesson: Lesson, rollout: Rollout, start: Genomes, seed: int, limit: int) -> tuple[Genomes, int]:
    """The champion [1, weights] of as many attempts as the steps allow, and the steps taken."""
    endless = replace(lesson.learner, attempts=1000)
    course = Course(replace(lesson, learner=endless, generations=ENDLESS_GENERATIONS), seed, start)
    for state, _ in teach(course, rollout, begin(course), time.perf_counter):
        if state.ticks >= limit:
            break
    if len(state.now.champion):
        verdict = judge(course, rollout, state.now)
        state = replace(ended(course, state, verdict), ticks=state.ticks + verdict.ticks)
    return best(state), state.ticks


def scores(plan: Plan, rollout: Rollout, genome: Genomes) -> Scores:
    """What it scores in each of the fresh episodes [runs]."""
    found: Scores = rollout.score(genome, layouts(plan.episodes, plan.runs)).total[0]
    return found


def outcome(
    kind: str,
    seed: int,
    weights: int,
    found: Scores,
    plain: float | None,
    steps: tuple[int, int],
    took: tuple[float, float],
) -> Outcome:
    """The outcome of a seed that scored so."""
    error = float(found.std(ddof=1)) / len(found) ** 0.5
    solved = float((found >= SOLVED).mean())
    return Outcome(kind, seed, weights, float(found.mean()), error, solved, plain, steps, *took, os.getloadavg()[2])


def read(plan: Plan, kind: str, seed: int) -> Outcome:
    """What was written down."""
    found = json.loads(plan.path(kind, seed).read_text())
    return Outcome(**found | {"steps": tuple(found["steps"])})


TEACHERS = {"hierarchy": hierarchy, "mlp": perceptron}  # in this order


def report(plan: Plan, outcomes: Sequence[Outcome]) -> str:
    """The page with the table of all seeds."""
    kinds = {kind: [each.mean for each in outcomes if each.kind == kind] for kind in TEACHERS}
    seeds = ((kind, len(means), sum(mean >= SOLVED for mean in means)) for kind, means in kinds.items())
    solved = "; ".join(f"{kind}: {count} of {of}" for kind, of, count in seeds)
    text = Template((FOLDER / "RESULTS.template.md").read_text(encoding="utf-8"))
    table = "\n".join(map(row, outcomes))
    return text.substitute(table=table, solved=solved, runs=f"{plan.runs:,}", episodes=plan.episodes)


def row(found: Outcome) -> str:
    """An outcome as a line of the table in RESULTS.template.md."""
    plain = "" if found.plain is None else f"{found.plain:.1f}"
    cells = (
        found.kind,
        found.seed,
        f"{found.mean:.1f} ± {found.standard_error:.1f}",
        f"{found.solved:.1%}",
        plain,
        found.weights,
        f"{sum(found.steps) / 1e6:.2f} M",
        f"{found.cpu_seconds:.0f} s",
        f"{found.seconds:.0f} s, {found.load:.0f}",
    )
    return f"| {' | '.join(map(str, cells))} |"


if __name__ == "__main__":
    main()
