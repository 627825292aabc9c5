"""A mind beside one perceptron of as many weights, from nothing: python examples/beside.py examples/lander --seeds 5.

Each seed is taught in one thread, into a folder under --out. The perceptron, and what else beside.toml names, is a mind
that uses the hierarchy: what is taught under its own master has as many steps of each learner as the hierarchy of its
seed took. All are tried in the same fresh episodes. It may be stopped at any time: the same command goes on with what
is left. RESULTS.template.md with the table of what is done in it is in --out as RESULTS.md.
"""

import argparse
import json
import os
import time
import tomllib
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from shutil import copyfile, rmtree
from string import Template

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.kinds.registry import names
from mindrun.sim.rollout import Rollout
from mindrun.terminal.arguments import real, whole
from mindrun.train.attempt import judge
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin, ended
from mindrun.train.population import Genomes, Scores
from mindrun.train.training import best

import mindlang
from mindlang.run.setup import NO_GENOME, layouts

HIERARCHY = "hierarchy"
ENDLESS_GENERATIONS, ENDLESS_ATTEMPTS = 10**6, 1000


@dataclass(frozen=True, slots=True)
class Comparison:
    """What beside.toml in an example's folder says.

    The `task` that episodes are of, and the score from which one is `solved`; `others`: the file of each mind beside
    the hierarchy, or the file and who is in charge in it, by its name in the table; `also`: a file and a master in it
    that tries what the hierarchy was taught, by what its column is called.
    """

    task: str
    solved: float
    others: Mapping[str, str | tuple[str, str]] = field(default_factory=lambda: {"mlp": "monolith.mind"})
    also: Mapping[str, tuple[str, str]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Outcome:
    """One seed of one mind: what it scores in fresh episodes, and what it took. Steps are by the kind of learner."""

    kind: str
    seed: int
    weights: int
    mean: float
    standard_error: float
    solved: float
    also: Mapping[str, float]
    steps: Mapping[str, int]
    seconds: float
    cpu_seconds: float
    load: float


@dataclass(frozen=True, slots=True)
class Taught:
    """A mind that was taught: its episodes with a genome, and those with other masters in charge."""

    rollout: Rollout
    genome: Genomes
    also: Mapping[str, Rollout]
    weights: int
    steps: Mapping[str, int]


@dataclass(frozen=True, slots=True)
class Plan:
    """Which example is taught where, in times so many generations, and in how many fresh episodes it is tried."""

    folder: Path
    comparison: Comparison
    out: Path
    runs: int
    episodes: int
    scale: float

    @property
    def teachers(self) -> Mapping[str, Callable[[int], Taught]]:
        """What is taught, in this order."""
        others = {kind: partial(beside, self, said) for kind, said in self.comparison.others.items()}
        return {HIERARCHY: partial(hierarchy, self), **others}

    def seed_folder(self, seed: int) -> Path:
        """Where the minds of a seed, and what they were taught, lie."""
        return self.out / f"seed-{seed}"

    def path(self, kind: str, seed: int) -> Path:
        """Where the outcome of a seed lies."""
        return self.out / f"{kind}-{seed}.json"


def main() -> None:
    """Teach what is left, and write the tables."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("example", type=Path, help="its folder, with beside.toml in it")
    parser.add_argument("--seeds", type=whole(1, 1000), default=5, help="how many")
    parser.add_argument("--first", type=whole(0, 2**32), default=1, help="the first of them")
    parser.add_argument("--runs", type=whole(2, 1_000_000), default=1000, help="fresh episodes of each seed")
    parser.add_argument("--episodes", type=whole(0, 2**62), default=20261123, help="draws the fresh episodes")
    parser.add_argument("--scale", type=real(0, 1000), default=1.0, help="times the generations of the mind's lessons")
    parser.add_argument("--processes", type=whole(1, 1024), default=2, help="seeds at a time")
    parser.add_argument("--out", type=Path, help="runs/NAME if nothing is said")
    options = parser.parse_args()
    folder = options.example.resolve()
    comparison = Comparison(**tomllib.loads((folder / "beside.toml").read_text(encoding="utf-8")))
    out = options.out or Path("runs") / folder.name
    plan = Plan(folder, comparison, out, options.runs, options.episodes, options.scale)
    seeds = range(options.first, options.first + options.seeds)
    out.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(options.processes, get_context("spawn")) as pool:
        for kind in plan.teachers:
            left = [seed for seed in seeds if not plan.path(kind, seed).exists()]
            for found in pool.map(partial(try_out, plan, kind), left):
                print(row(plan, found), flush=True)
                (out / "RESULTS.md").write_text(report(plan, seeds), encoding="utf-8")
    (out / "RESULTS.md").write_text(report(plan, seeds), encoding="utf-8")


def try_out(plan: Plan, kind: str, seed: int) -> Outcome:
    """Teach a seed of a kind, try it, and write down what came of it."""
    began, cpu = time.perf_counter(), time.process_time()
    came = plan.teachers[kind](seed)
    took = time.perf_counter() - began, time.process_time() - cpu
    score = scores(plan, came.rollout, came.genome)
    also = {name: float(scores(plan, other, NO_GENOME).mean()) for name, other in came.also.items()}
    error, solved = float(score.std(ddof=1)) / len(score) ** 0.5, float((score >= plan.comparison.solved).mean())
    load = os.getloadavg()[2]
    found = Outcome(kind, seed, came.weights, float(score.mean()), error, solved, also, came.steps, *took, load)
    path = plan.path(kind, seed)
    path.with_suffix(".part").write_text(json.dumps(asdict(found), indent=1) + "\n", encoding="utf-8")
    path.with_suffix(".part").replace(path)
    return found


def hierarchy(plan: Plan, seed: int) -> Taught:
    """Teach all lessons of the mind that has the name of its folder."""
    folder = plan.seed_folder(seed)
    rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for source in plan.folder.glob("*.mind"):
        copyfile(source, folder / source.name)
    path, task = folder / f"{plan.folder.name}.mind", plan.comparison.task
    options = mindlang.TrainOptions(scale=plan.scale)
    results = mindlang.load(path).train(options=options, seed=seed, runs=folder / "runs")
    mind = mindlang.load(path)
    steps: Counter[str] = Counter()
    for result, lesson in zip(results, mind.graph.lessons, strict=True):
        steps[names()[type(lesson.learner)]] += int(result["ticks"])
    learners = sorted({skill for each in results for skill in each["weights"]})
    weights = mind.rollout(task, mind.graph.master, learners).genome_length
    also = {name: mindlang.load(folder / file).rollout(task, who) for name, (file, who) in plan.comparison.also.items()}
    return Taught(mind.rollout(task, mind.graph.master), NO_GENOME, also, weights, dict(steps))


def beside(plan: Plan, said: str | tuple[str, str], seed: int) -> Taught:
    """Teach the lessons under a master, each in as many steps as its learner had in the hierarchy."""
    limits = read(plan, HIERARCHY, seed).steps
    file, *named = [said] if isinstance(said, str) else said
    mind = mindlang.load(plan.seed_folder(seed) / file)
    [master] = named or [mind.graph.master]
    lessons = [lesson for lesson in mind.graph.lessons if lesson.master == master]
    skills = sorted({lesson.skill for lesson in lessons})
    rollout = mind.rollout(plan.comparison.task, master, skills)
    champion, steps = np.empty((0, rollout.genome_length), np.float32), {}
    for lesson in lessons:
        learner, there = names()[type(lesson.learner)], mind.rollout(lesson.task, master, skills)
        champion, steps[learner] = taught(lesson, there, champion, seed, limits[learner])
    return Taught(rollout, champion, {}, rollout.genome_length, steps)


def taught(lesson: Lesson, rollout: Rollout, start: Genomes, seed: int, limit: int) -> tuple[Genomes, int]:
    """The champion [1, weights] of as many attempts as the steps allow, and the steps taken."""
    endless = replace(lesson.learner, attempts=ENDLESS_ATTEMPTS)
    course = Course(replace(lesson, learner=endless, generations=ENDLESS_GENERATIONS), seed, start)
    executor = InThisThread(course, rollout, time.perf_counter)
    for step in side_by_side(course, executor, begin(course), lambda: False):
        state = step.state
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


def read(plan: Plan, kind: str, seed: int) -> Outcome:
    """What was written down."""
    return Outcome(**json.loads(plan.path(kind, seed).read_text(encoding="utf-8")))


def report(plan: Plan, seeds: Sequence[int]) -> str:
    """The page with the table of the seeds that have been taught."""
    done = {kind: [seed for seed in seeds if plan.path(kind, seed).exists()] for kind in plan.teachers}
    outcomes = {kind: [read(plan, kind, seed) for seed in numbers] for kind, numbers in done.items()}
    text = Template((plan.folder / "RESULTS.template.md").read_text(encoding="utf-8"))
    solved = "; ".join(solving(plan, kind, found) for kind, found in outcomes.items())
    rows = table(plan, [each for found in outcomes.values() for each in found])
    return text.substitute(table=rows, solved=solved, runs=f"{plan.runs:,}", episodes=plan.episodes)


def solving(plan: Plan, kind: str, found: Sequence[Outcome]) -> str:
    """How many seeds of a kind solve it."""
    return f"{kind}: {sum(each.mean >= plan.comparison.solved for each in found)} of {len(found)}"


def table(plan: Plan, outcomes: Sequence[Outcome]) -> str:
    """A row for each outcome, below what its columns are."""
    share = f"episodes of {plan.comparison.solved:g} and more"
    head = ("", "seed", "score", share, *plan.comparison.also, "weights", "steps", "CPU", "wall clock, load")
    return "\n".join((line(head), "|" + "---|" * len(head), *(row(plan, each) for each in outcomes)))


def row(plan: Plan, found: Outcome) -> str:
    """An outcome as a line of the table."""
    mean, share = f"{found.mean:.1f} ± {found.standard_error:.1f}", f"{found.solved:.1%}"
    also = (f"{found.also[name]:.1f}" if name in found.also else "" for name in plan.comparison.also)
    took = f"{found.cpu_seconds:.0f} s", f"{found.seconds:.0f} s, {found.load:.0f}"
    steps = f"{sum(found.steps.values()) / 1e6:.2f} M"
    return line((found.kind, found.seed, mean, share, *also, found.weights, steps, *took))


def line(cells: Sequence[object]) -> str:
    """A line of a table in Markdown."""
    return f"| {' | '.join(map(str, cells))} |"


if __name__ == "__main__":
    main()
