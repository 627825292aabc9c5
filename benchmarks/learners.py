"""Learners at the same number of ticks: python benchmarks/learners.py [--skill Avoid] [--ticks 100e6] [--seeds 20].

    --genetic octaves=2,short=0.1,generations=30   `genetic`, other than its defaults; may be repeated
    --restarting generations=50,mutation=2         `restarting`; generations of an attempt, another follows
    --evolution_strategy mutation=0.2              `evolution_strategy`
    --cmaes population_size=32,sigma=1             CMA-ES by the library cmaes (pip install cmaes); may be repeated

Every seed teaches the skill from scratch, subskills as in the lock, with the lesson's own code: attempt after attempt
until the ticks are spent. With `--finishing on_the_job.mind` it teaches the skill and all below it, each attempt from
the weights that they have there. The champion is chosen as in a lesson, and runs on 100 layouts that the training has
not seen. A seed has succeeded if that counts as much as examples/collect/paper asks of an attempt.
"""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from multiprocessing import get_context
from typing import Any

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.weights import learners
from mindrun.kinds.learners import EvolutionStrategy, Genetic, Restarting
from mindrun.processors import cores
from mindrun.sim.rollout import Rollout
from mindrun.train.attempt import REEVALUATED_CANDIDATES, REEVALUATION_GENERATIONS, judge
from mindrun.train.attempt import REEVALUATION_LAYOUTS as TRIES
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin, ended
from mindrun.train.population import MAX_WEIGHT, Genomes, order
from mindrun.train.training import best

from benchmarks.learning import FRESH_LAYOUTS, prepared
from benchmarks.workloads import COLLECT, collect, shipped

sys.path.append(str(COLLECT.parent / "paper"))
from protocol import SUCCESS

KINDS = {"genetic": Genetic, "restarting": Restarting, "evolution_strategy": EvolutionStrategy}
ENDLESS_GENERATIONS = 10**6  # generations
LINE = (
    "{name:<64} {succeeded:>3} of {seeds}  {score:8.1f} ± {error:5.1f}  {count:6.2f} ± {count_error:.2f} per run, "
    "worst {worst:.1f}  {ticks:4.0f} M ticks, {seconds:5.1f} s CPU a seed"
)
Said = dict[str, float | int]


@dataclass(frozen=True, slots=True)
class Trial:
    """One seed of one learner on a skill."""

    kind: str
    said: tuple[tuple[str, float | int], ...]
    skill: str
    ticks: float
    seed: int
    finishing: str = ""


@dataclass(frozen=True, slots=True)
class Teaching:
    """What a trial teaches: the lesson, what scores it in one thread, and the weights that it begins with, if any."""

    lesson: Lesson
    rollout: Rollout
    start: Genomes


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a trial: means over fresh layouts, and what it took."""

    score: float
    count: float
    ticks: int
    seconds: float


def tried(trial: Trial) -> Outcome:
    """Teach, and run what was learnt."""
    teaching = teaching_of(trial.skill, trial.finishing)
    began = time.process_time()
    learn = by_covariance if trial.kind == "cmaes" else by_lesson
    champion, ticks = learn(trial, teaching)
    seconds = time.process_time() - began
    scores = teaching.rollout.score(champion, [int(word) for word in FRESH_LAYOUTS])
    return Outcome(float(scores.total.mean()), float(scores.counts.mean()), ticks, seconds)


@cache
def teaching_of(skill: str, finishing: str) -> Teaching:
    """The skill's first lesson from scratch, or with all below it from what is known in the file `finishing`."""
    if not finishing:
        graph, weights, _ = collect()
        lesson, rollout = prepared(graph, weights, skill, 1)
        return Teaching(lesson, rollout, np.empty((0, rollout.genome_length), np.float32))
    ready = shipped(finishing)
    lesson = next(each for each in ready.policy.graph.lessons if each.skill == skill == each.master)
    lesson = replace(lesson, with_subskills=True)
    taught = learners(ready.policy.graph, lesson)
    rollout = Rollout(ready.policy, lesson.task, lesson.master, taught)
    rollout.compile()
    return Teaching(lesson, rollout, np.concatenate([ready.policy.weights[each] for each in taught])[None])


def by_lesson(trial: Trial, teaching: Teaching) -> tuple[Genomes, int]:
    """The champion [1, weights] of as many attempts as the ticks allow, and the ticks taken."""
    said = dict(trial.said)
    generations = int(said.pop("generations", ENDLESS_GENERATIONS))
    learner = replace(KINDS[trial.kind](), **said, attempts=1000)
    lesson = replace(teaching.lesson, learner=learner, generations=generations)
    course, rollout = Course(lesson, trial.seed, teaching.start), teaching.rollout
    state = begin(course)
    for step in side_by_side(course, InThisThread(course, rollout, time.perf_counter), state, lambda: False):
        state = step.state
        if state.ticks >= trial.ticks:
            break
    if len(state.now.champion):
        verdict = judge(course, rollout, state.now)
        state = replace(ended(course, state, verdict), ticks=state.ticks + verdict.ticks)
    return best(state), state.ticks


def by_covariance(trial: Trial, teaching: Teaching) -> tuple[Genomes, int]:
    """The champion [1, weights] of CMA-ES after so many ticks, and the ticks taken."""
    from cmaes import CMA

    rng, layouts, rollout = np.random.default_rng(trial.seed), teaching.lesson.learner.layouts, teaching.rollout
    champion, taken, generations = teaching.start, 0, 0
    options: dict[str, Any] = {"sigma": 2.0, **dict(trial.said)}
    mean = champion[0].astype(float) if len(champion) else np.zeros(rollout.genome_length)
    cma = CMA(mean=mean, seed=int(rng.integers(2**31)), **options)
    while taken < trial.ticks or generations % REEVALUATION_GENERATIONS:
        asked = np.array([cma.ask() for _ in range(cma.population_size)])
        genomes = np.clip(asked, -MAX_WEIGHT, MAX_WEIGHT).astype(np.float32)
        scores = rollout.score(genomes, seeds(rng, layouts))
        totals = scores.total.mean(axis=1)
        worst = np.where(np.isfinite(totals), -totals, 1e9)
        cma.tell([(genome.astype(float), float(bad)) for genome, bad in zip(genomes, worst, strict=True)])
        taken, generations = taken + int(scores.ticks.sum()), generations + 1
        if generations % REEVALUATION_GENERATIONS == 0:
            candidates = np.concatenate([champion, genomes[order(totals)][:REEVALUATED_CANDIDATES]])
            scores = rollout.score(candidates, seeds(rng, TRIES))
            taken += int(scores.ticks.sum())
            champion = candidates[order(scores.total.mean(axis=1))][:1]
    return champion, taken


def seeds(rng: np.random.Generator, count: int) -> list[int]:
    """The seeds of so many layouts."""
    return [int(word) for word in rng.integers(2**62, size=count)]


def compare(options: argparse.Namespace, trials: Callable[[Trial], Iterator[Outcome]]) -> None:
    """Print what each learner reaches, on the mean over the seeds with its standard error."""
    for kind, said in [("genetic", {}), *options.learners]:
        outcomes = list(trials(Trial(kind, tuple(said.items()), options.skill, options.ticks, 0, options.finishing)))
        counts = np.array([outcome.count for outcome in outcomes])
        scores = np.array([outcome.score for outcome in outcomes])
        print(
            LINE.format(
                name=" ".join([kind, *(f"{key}={value:g}" for key, value in said.items())]),
                succeeded=int((counts >= (options.at_least or SUCCESS[options.skill])).sum()),
                seeds=len(outcomes),
                score=scores.mean(),
                error=standard_error(scores),
                count=counts.mean(),
                count_error=standard_error(counts),
                worst=counts.min(),
                ticks=np.mean([outcome.ticks for outcome in outcomes]) / 1e6,
                seconds=np.mean([outcome.seconds for outcome in outcomes]),
            ),
            flush=True,
        )


def standard_error(numbers: np.ndarray[Any, Any]) -> float:
    """The standard error of the mean of numbers; 0 for a single one."""
    return float(numbers.std(ddof=1)) / len(numbers) ** 0.5 if len(numbers) > 1 else 0.0


class Learners(argparse.Action):
    """`--genetic octaves=2`: a learner, and what it says for itself."""

    def __call__(self, parser: argparse.ArgumentParser, namespace: Any, text: Any, option: str | None = None) -> None:
        kind = (option or "").lstrip("-")
        pairs = (part.partition("=") for part in text.split(",") if part)
        said: Said = {key: int(value) if value.isdecimal() else float(value) for key, _, value in pairs}
        if "attempts" in said:
            parser.error("attempts are as many as the ticks allow")
        namespace.learners = [*namespace.learners, (kind, said)]


def main() -> None:
    """Compare."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--skill", default="GoToObject", choices=[*SUCCESS])
    parser.add_argument("--ticks", type=float, default=40e6)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first seed, others follow")
    parser.add_argument("--at-least", type=float, metavar="COUNT", help="what counts as a success")
    parser.add_argument("--workers", type=int, default=cores(), help="seeds at a time")
    parser.add_argument("--finishing", default="", metavar="FILE", help="with whose weights it begins")
    for kind in (*KINDS, "cmaes"):
        parser.add_argument(f"--{kind}", action=Learners, dest="learners", default=[], metavar="NAME=NUMBER,…")
    options = parser.parse_args()
    weights = teaching_of(options.skill, options.finishing).rollout.genome_length  # compiled once
    print(f"{options.skill}, {weights} weights, {options.ticks / 1e6:g} M ticks, seeds from {options.first} on")
    with ProcessPoolExecutor(options.workers, get_context("spawn")) as pool:
        compare(
            options,
            lambda trial: pool.map(tried, [replace(trial, seed=options.first + i) for i in range(options.seeds)]),
        )


if __name__ == "__main__":
    main()
