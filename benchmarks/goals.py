"""Goals against the shipped rewards of the six tasks of Collect: python -m benchmarks.goals --seeds 5 --first 1.

Each skill is taught alone, from scratch, above subskills as shipped, by the same lesson with the same seeds: on the
shipped task, on the same with goals in the place of its rewards, and where the rewards pay for driving forward, with
goals that prefer it. As the lesson goes on, the best so far is chosen as a lesson chooses, and what the task counts is
measured on layouts that no training has seen.

A task's bar is 90 % of what the rewards come to at the end of their lessons, in the mean over the seeds. A seed is in
time if goals come to it within 1.25 times the ticks of the rewards, or of their whole lesson where these do not come to
it; `ticks` is the median of that ratio. The row of the rewards holds them against the rewards of each other seed: so
often, and so soon, is one in time by chance. `count` is that after the ticks of the rewards' lesson.
"""

import argparse
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.policy import Policy
from mindrun.graph.weights import Weights
from mindrun.sim.rollout import Rollout
from mindrun.train.attempt import REEVALUATION_LAYOUTS, generation, reevaluate
from mindrun.train.lesson_state import Course, begin_attempt
from mindrun.train.population import Genomes
from mindrun.train.scoring import Purpose, layouts

from benchmarks.learners import standard_error
from benchmarks.workloads import COLLECT, collect, graph_of
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

SHARE_OF_COUNT, SHARE_OF_TICKS = 0.9, 1.25
CURVE_ATTEMPT = 1  # the number of an attempt that no lesson makes: its layouts are the curve's
UNSEEN_SEED, UNSEEN_LAYOUTS = 99, 100
LESSONS = """
curriculum Goals is genetic octaves 2
  teaches GoToObject on GoToObject for 62 generations founders 3000 short 7% mutated 20%
  teaches GoToDropZone on GoToDropZone for 62 generations founders 3000 short 7% mutated 20%
  teaches Avoid on Avoid for 78 generations population 60 short 6% mutated 2%
  teaches GoToObject+Avoid on GoToObject+Avoid for 20 generations founders 600
  teaches GoToDropZone+Avoid on GoToDropZone+Avoid for 20 generations founders 600
  teaches Collect on Collect for 16 generations founders 600 short 12%
"""
GOALS = {
    "GoToObject": ["wants 40 reach of object"],
    "GoToDropZone": ["wants 40 reach of drop_zone"],
    "Avoid": ["wants 200 visit of patch size 4", "avoids collision"],
    "GoToObject+Avoid": ["wants 15 reach of object", "avoids collision"],
    "GoToDropZone+Avoid": ["wants 15 reach of drop_zone", "avoids collision"],
    "Collect": ["wants 20 delivery of object to drop_zone", "avoids collision"],
}
FORWARD = {task: [*GOALS[task], "prefers much forward"] for task in ("GoToObject", "GoToDropZone", "Avoid")}
WAYS: dict[str, dict[str, list[str]]] = {"rewards": {}, "goals": GOALS, "and forward": FORWARD}


@dataclass(frozen=True, slots=True)
class Curve:
    """The ticks taken and the count of the best so far, at each look at a lesson, and the ticks of the whole lesson."""

    looks: tuple[tuple[int, float], ...]
    lesson_ticks: int

    def __str__(self) -> str:
        said = ", ".join(f"{ticks / 1e6:.2f} {count:.1f}" for ticks, count in self.looks)
        return f"{self.lesson_ticks / 1e6:.2f} M ticks: {said}"

    def count_at(self, ticks: int) -> float:
        return [0.0, *(count for at, count in self.looks if at <= ticks)][-1]

    def reaches(self, bar: float) -> float:
        """The ticks with which it first counts so many; ∞ where it does not."""
        return next((float(ticks) for ticks, count in self.looks if count >= bar), inf)


def graph(goals: dict[str, list[str]]) -> Graph:
    """The example with the lessons of this benchmark, and with goals in the tasks that have some here."""
    text = COLLECT.read_text(encoding="utf-8").partition("curriculum")[0] + LESSONS
    for task, lines in goals.items():
        head, word, rest = text.partition(f"task {task} in ")
        block, end, after = rest.partition("\n\n")
        kept = [line for line in block.split("\n") if not re.match("  (rewards|ends|counts) ", line)]
        text = head + word + "\n".join([*kept, *(f"  {line}" for line in lines)]) + end + after
    return graph_of(compile_source(Source(COLLECT.name, text, COLLECT.parent)))


class Teaching:
    """All ways to teach a skill: what scores its genomes, and what counts."""

    def __init__(self, task: str, weights: dict[str, Weights], options: argparse.Namespace) -> None:
        self.options = options
        self.lessons, self.rollouts = dict[str, Lesson](), dict[str, Rollout]()
        for way, goals in WAYS.items():
            if goals and task not in goals:
                continue
            taught = graph(goals)
            lesson = next(each for each in taught.lessons if each.skill == task)
            self.lessons[way] = replace(lesson, generations=options.generations or lesson.generations)
            self.rollouts[way] = Rollout(Policy(taught, weights), task, task, [task], workers=options.workers)
            self.rollouts[way].compile()

    def counts(self, champion: Genomes) -> float:
        """The mean count in the shipped task, on layouts that are the same for all."""
        unseen = layouts(UNSEEN_SEED, 0, 0, UNSEEN_LAYOUTS).tolist()
        return float(self.rollouts["rewards"].score(champion, unseen).counts.mean())

    def curve(self, way: str, seed: int, ticks: int = 0) -> Curve:
        """The curve of a lesson, which goes on until as many ticks are taken as a slower one may take."""
        rollout, lesson = self.rollouts[way], self.lessons[way]
        course = Course(lesson, seed, np.empty((0, rollout.genome_length), np.float32))
        state, champion = begin_attempt(course), course.start
        taken, whole, looks = 0, 0, list[tuple[int, float]]()
        while not whole or taken < SHARE_OF_TICKS * (ticks or whole):
            state, record = generation(course, rollout, 0, state)
            taken, number = taken + record.ticks, state.population.generation
            whole = whole or (taken if number == lesson.generations else 0)
            if number == 1 or number % self.options.every == 0 or number >= lesson.generations:
                fresh = layouts(seed, CURVE_ATTEMPT, number, REEVALUATION_LAYOUTS, Purpose.REEVALUATION)
                looked, *_ = reevaluate(replace(state, champion=champion), rollout, fresh)
                is_same = looks and np.array_equal(looked.champion, champion)
                looks.append((taken, looks[-1][1] if is_same else self.counts(looked.champion)))
                champion = looked.champion
        return Curve(tuple(looks), whole)


def rows(task: str, found: dict[str, list[Curve]]) -> Iterator[str]:
    """The rows of a task, one for each way; that of the rewards holds them against those of other seeds."""
    lessons = [each.lesson_ticks for each in found["rewards"]]
    ends = {way: np.array([*map(Curve.count_at, curves, lessons)]) for way, curves in found.items()}
    bar = SHARE_OF_COUNT * float(ends["rewards"].mean())
    needed = np.array([*map(min, [each.reaches(bar) for each in found["rewards"]], lessons)])
    for way, curves in found.items():
        ratios = np.array([each.reaches(bar) for each in curves]) / needed[:, None]
        pairs = ratios[~np.eye(len(curves), dtype=bool)] if way == "rewards" else ratios.diagonal()
        in_time = f"{(pairs <= SHARE_OF_TICKS).sum()} of {len(pairs)}"
        reached = f"{sum(each.reaches(bar) < inf for each in curves)} of {len(curves)}"
        median = f"{np.median(pairs):.2f}" if len(pairs) else "-"
        count = f"{ends[way].mean():.2f} ± {standard_error(ends[way]):.2f}"
        yield f"{task:<20}{way:<13}{in_time:>10}{median:>10}{bar:>10.2f}{reached:>10}{count:>17}"


def main() -> None:
    """Teach both ways, and compare."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--tasks", nargs="+", default=[*GOALS], choices=[*GOALS], metavar="TASK")
    parser.add_argument("--every", type=int, default=3, metavar="GENERATIONS", help="between two looks at a lesson")
    parser.add_argument("--generations", type=int, default=0, help="of each lesson, in the place of its own")
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    _, weights, _ = collect()
    table = [f"{'task':<20}{'':<13}{'in time':>10}{'ticks':>10}{'bar':>10}{'reached':>10}{'count':>17}"]
    for task in options.tasks:
        teaching, found = Teaching(task, weights, options), dict[str, list[Curve]]()
        for seed in range(options.first, options.first + options.seeds):
            for way in teaching.rollouts:
                whole = found["rewards"][-1].lesson_ticks if way != "rewards" else 0
                found.setdefault(way, []).append(teaching.curve(way, seed, whole))
                print(f"{task} {seed} {way}: {found[way][-1]}", flush=True)
        table += rows(task, found)
        print("\n".join(table[-len(found) :]), flush=True)
    print("", *table, sep="\n")


if __name__ == "__main__":
    main()
