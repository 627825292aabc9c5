"""Orders of lessons: python -m benchmarks.lesson_order --curriculum collect --seeds 5 --first 1 --times 1 --slice 10.

Each seed teaches the lessons in the declared order and, from scratch in as many ticks, by progress: a slice of
generations at a time goes to the lesson whose champion has gained most of late. `collect` are the six lessons of
examples/collect with shorter runs, `worlds` is one skill in four worlds, which takes them in turn, too; there a lesson
that goes on after another begins with its champion. What was learnt runs on 200 layouts that no training has seen.
With --exceed whoever chooses ends after the slice that is too much, not before it.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations
from math import inf
from typing import Any

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import Weights, parts
from mindrun.sim.rollout import Rollout
from mindrun.train.attempt import REEVALUATION_GENERATIONS, generation
from mindrun.train.lesson_state import AttemptState, Course, begin_attempt
from mindrun.train.scoring import layouts

from benchmarks.learners import ENDLESS_GENERATIONS, standard_error
from benchmarks.workloads import COLLECT, graph_of
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

LEAST_GAIN = 0.05  # of the range of its re-evaluations, with which a lesson keeps those above it waiting
UNSEEN_SEED, UNSEEN_LAYOUTS = 99, 200
SHORTER = {"10000 ticks": "2500 ticks", "30000 ticks": "6000 ticks", "1000 gen": "40 gen", "1500 gen": "60 gen"}
WORLDS = """
scene Few is arena size 60
  contains rock is obstacle grid 30 size 4 to 8 jitter 1
task Open in arena size 60
{task}
task FewRocks in Few
{task}
skill Seek is mlp hidden 2
  reads proximity
  reads object_bearing
  reads object_drift
  drives left_wheel
  drives right_wheel
curriculum Worlds is genetic population 40 octaves 2
  teaches Seek on GoToObject for 60 generations
  teaches Seek on Open for 60 generations
  teaches Seek on FewRocks for 60 generations
  teaches Seek on GoToObject+Avoid for 60 generations
"""


@dataclass(frozen=True, slots=True)
class Slice:
    """Some generations of the lesson at `place`: their ticks, the champion's score, and the attempt, to go on."""

    place: int
    ticks: int
    score: float
    seed: int
    state: AttemptState


@dataclass(frozen=True, slots=True)
class Life:
    """All slices of one seed, and what it knows."""

    graph: Graph
    seed: int
    slices: tuple[Slice, ...]
    weights: dict[str, Weights]

    @property
    def ticks(self) -> int:
        return sum(each.ticks for each in self.slices)

    @property
    def has_one_skill(self) -> bool:
        return len({lesson.skill for lesson in self.graph.lessons}) == 1

    def of(self, place: int) -> list[Slice]:
        return [each for each in self.slices if each.place == place]

    def needs(self, place: int) -> set[int]:
        """The places of the lessons of the skills right below."""
        skill = next(skill for skill in self.graph.skills if skill.name == self.graph.lessons[place].skill)
        below = {self.graph.skills[edge.target].name for edge in skill.edges if edge.to == "skill"}
        return {number for number, lesson in enumerate(self.graph.lessons) if lesson.skill in below}


def graph(curriculum: str) -> Graph:
    """The example with shorter runs and lessons, or the worlds of one skill beside its tasks."""
    text = COLLECT.read_text(encoding="utf-8").replace("population 100", "population 40 octaves 2")
    for declared, shorter in SHORTER.items():
        text = text.replace(declared, shorter)
    if curriculum == "worlds":
        task = text.partition("task GoToObject+Avoid in Rocks\n")[2].partition("\n\n")[0]
        text = text.partition("curriculum")[0] + WORLDS.format(task=task)
    return graph_of(compile_source(Source(COLLECT.name, text, COLLECT.parent)))


def taught(life: Life, place: int, generations: int) -> Life:
    """A slice of a lesson later."""
    lesson = replace(life.graph.lessons[place], generations=ENDLESS_GENERATIONS)
    weights, one = life.weights, life.has_one_skill
    rollout = Rollout(Policy(life.graph, weights), lesson.task, lesson.skill, [lesson.skill], interrupt=False)
    knows = one and lesson.skill in weights
    start = weights[lesson.skill][None] if knows else np.empty((0, rollout.genome_length), np.float32)
    before = (life.slices[-1:] if one else life.slices)[::-1]
    course = Course(lesson, life.seed * 100 + place + (1000 * len(life.slices) if one else 0), start)
    now = Slice(place, 0, -inf, course.seed, begin_attempt(course))
    now = replace(next((each for each in before if each.place == place), now), ticks=0)
    for _ in range(generations):
        state, record = generation(replace(course, seed=now.seed), rollout, 0, now.state)
        score = now.score if record.reevaluated is None else record.reevaluated
        now = replace(now, ticks=now.ticks + record.ticks, score=score, state=state)
    learnt = parts(life.graph, [lesson.skill], now.state.champion[0])
    return replace(life, slices=(*life.slices, now), weights=weights | learnt)


def in_turn(life: Life) -> int:
    """The next lesson, round and round."""
    return len(life.slices) % len(life.graph.lessons)


def by_progress(life: Life) -> int:
    """The lesson that gains most; one above others where none that is open gains enough, and it closes those below."""
    begun = {each.place for each in life.slices}
    fresh = [n for n in range(len(life.graph.lessons)) if n not in begun and life.needs(n) <= begun]
    if lowest := [place for place in fresh if not life.needs(place)]:
        return lowest[0]
    closed = {need for place in begun for need in life.needs(place)}
    gain, place = max((gained([each.score for each in life.of(place)]), -place) for place in begun - closed)
    return fresh[0] if fresh and gain < LEAST_GAIN else -place


def gained(scores: list[float]) -> float:
    """The gain of the last two slices as a share of the range of all; ∞ before there are three."""
    if len(scores) < 3:
        return inf
    span = max(scores) - min(scores)
    return (max(scores[-2:]) - scores[-3]) / span if span > 0 else 0.0


def within(life: Life, ticks: int, choose: Callable[[Life], int], options: argparse.Namespace) -> Life:
    """A life after all slices of chosen lessons that fit in the ticks; one takes as long as the last of its lesson."""
    while life.ticks < ticks:
        place = choose(life)
        if not options.exceed and life.ticks + sum(each.ticks for each in life.of(place)[-1:]) > ticks:
            break
        life = taught(life, place, options.slice)
    return life


def counts(life: Life) -> list[float]:
    """The mean counts of all lessons' tasks on fresh layouts; 0 where the skill has not begun."""
    found, policy = [0.0] * len(life.graph.lessons), Policy(life.graph, life.weights)
    for place, lesson in enumerate(life.graph.lessons):
        if lesson.skill in life.weights:
            rollout = Rollout(policy, lesson.task, lesson.skill, interrupt=False)
            unseen = layouts(UNSEEN_SEED, 0, 0, UNSEEN_LAYOUTS).tolist()
            scores = rollout.score(np.empty((1, 0), np.float32), unseen)
            found[place] = float(scores.counts[0].mean())
    return found


def lives(life: Life, options: argparse.Namespace) -> dict[str, Life]:
    """What a seed, which knows nothing, comes to in each order."""
    declared = life
    for place, lesson in enumerate(life.graph.lessons):
        for _ in range(lesson.generations * options.times // options.slice):
            declared = taught(declared, place, options.slice)
    orders = ({"in turn": in_turn} if life.has_one_skill else {}) | {"by progress": by_progress}
    found = {name: within(life, declared.ticks, choose, options) for name, choose in orders.items()}
    return {"declared": declared} | found


def told(name: str, found: np.ndarray[Any, Any]) -> str:
    """A row of the table, of counts [seeds, lessons]: the last lesson, and the mean of all."""
    columns = (f"{each.mean():.2f} ± {standard_error(each):.2f}" for each in (found[:, -1], found.mean(axis=1)))
    return f"{name:<24}" + "".join(f"{column:>18}" for column in columns)


def main() -> None:
    """Compare."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--curriculum", default="collect", choices=["collect", "worlds"])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--times", type=int, default=1, help="as many generations as are declared")
    parser.add_argument("--slice", type=int, default=10, metavar="GENERATIONS", help="a multiple of ten")
    parser.add_argument("--exceed", action="store_true")
    options = parser.parse_args()
    if options.slice < 1 or options.slice % REEVALUATION_GENERATIONS:
        parser.error("a slice ends with a re-evaluation, of which there is one in ten generations")
    found = dict[str, list[list[float]]]()
    for seed in range(options.first, options.first + options.seeds):
        for name, life in lives(Life(graph(options.curriculum), seed, (), {}), options).items():
            found.setdefault(name, []).append(counts(life))
            slices = " ".join(str(len(life.of(place))) for place in range(len(life.graph.lessons)))
            said = " ".join(f"{count:.3f}" for count in found[name][-1])
            print(f"{seed} {name}, {life.ticks / 1e6:.2f} M ticks, slices {slices}: {said}", flush=True)
    print(f"\n{'':<24}{'the last lesson':>18}{'mean of all':>18}")
    every = {name: np.array(each) for name, each in found.items()}
    for name, each in every.items():
        print(told(name, each))
    for first, second in combinations(every, 2):
        print(told(f"{second} − {first}", every[second] - every[first]))


if __name__ == "__main__":
    main()
