"""How soon a skill is good: python benchmarks/learning.py [--skill GoToObject] [--seconds 60] [--seeds 10] [--json].

Every seed teaches the skill from scratch on all cores for so many seconds of training, subskills as in the lock. Then
its champion runs on 100 layouts that the training has not seen. The first compilation is not counted.
"""

import argparse
import json
import resource
import time
from dataclasses import replace
from typing import Any

import numpy as np
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.policy import Policy
from mindrun.processors import cores
from mindrun.sim.rollout import Rollout
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin

from benchmarks.workloads import collect

FRESH_LAYOUTS = np.random.SeedSequence(20_211_121).generate_state(100, np.uint64)
ENDLESS_GENERATIONS = 10**6  # generations
LINE = (
    "seed {seed:>3}: {count_mean:7.2f} ± {standard_error:.2f} per run, score {score_mean:8.1f}, "
    "{generations:>4} generations, {ticks_per_second:,.0f} ticks/s"
)


def learn(lesson: Lesson, rollout: Rollout, seed: int, seconds: float) -> dict[str, Any]:
    """One seed, and what its champion does on the fresh layouts."""
    course = Course(
        replace(lesson, generations=ENDLESS_GENERATIONS), seed, np.zeros((0, rollout.genome_length), np.float32)
    )
    start = time.perf_counter()
    executor = InThisThread(course, rollout, time.perf_counter)
    *_, last = side_by_side(course, executor, begin(course), lambda: time.perf_counter() - start >= seconds)
    state, taken = last.state, time.perf_counter() - start
    scores = rollout.score(state.now.champion, [int(word) for word in FRESH_LAYOUTS])
    counts = scores.counts[0]
    return {
        "seed": seed,
        "count_mean": float(counts.mean()),
        "standard_error": float(counts.std(ddof=1) / len(counts) ** 0.5),
        "score_mean": float(scores.total.mean()),
        "generations": state.now.population.generation,
        "ticks": state.ticks,
        "seconds": taken,
        "ticks_per_second": state.ticks / taken,
    }


def prepared(graph: Graph, weights: dict[str, Any], skill: str, workers: int) -> tuple[Lesson, Rollout]:
    """The skill's first lesson and its rollout, compiled."""
    lesson = next(lesson for lesson in graph.lessons if lesson.skill == skill)
    rollout = Rollout(Policy(graph, weights), lesson.task, lesson.master, [skill], workers=workers)
    rollout.compile()
    return lesson, rollout


def main() -> None:
    """Teach, try, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--skill", default="GoToObject")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--workers", type=int, default=cores())
    parser.add_argument("--at-least", type=float, default=15.0, help="the count from which a seed has succeeded")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    graph, weights, _ = collect()
    lesson, rollout = prepared(graph, weights, options.skill, options.workers)
    runs = []
    for seed in range(1, options.seeds + 1):
        runs.append(learn(lesson, rollout, seed, options.seconds))
        if not options.json:
            print(LINE.format(**runs[-1]), flush=True)
    found = {
        "skill": options.skill,
        "seconds": options.seconds,
        "workers": options.workers,
        "at_least": options.at_least,
        "succeeded": sum(run["count_mean"] >= options.at_least for run in runs),
        "of": len(runs),
        "memory_mib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "runs": runs,
    }
    if options.json:
        print(json.dumps(found))
    else:
        print("{succeeded} of {of} seeds reach {at_least:g}; {memory_mib:.0f} MiB resident".format(**found))


if __name__ == "__main__":
    main()
