"""What a function and a learner come to in so many ticks: python benchmarks/neat.py [--skill Avoid --ticks 100e6].

Teaches a skill of examples/collect from scratch with each seed, with the function and the arguments of `genetic` that
are given, and tries its champion on 100 layouts that the training has not seen. With `--speed` it compares instead how
fast runs go with an mlp of as many weights, in turns.
"""

import argparse
import json
import re
import time
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.train.attempts import InThisThread, side_by_side
from mindrun.train.lesson_state import Course, begin

from benchmarks.learning import FRESH_LAYOUTS
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

COLLECT = Path(__file__).parents[1] / "examples" / "collect" / "collect.mind"
LEARNER = "founders 2000 layouts 1 species 8 octaves 2 mutated 100%"
LINE = "seed {seed}: {count:7.2f} ± {error:.2f} per run, {links}, {millions:.1f} M ticks in {seconds:.0f} s"


def prepared(skill: str, function: str, learner: str = "") -> tuple[Any, Rollout]:
    """The skill's first lesson and its rollout, compiled, where it has this function and learner."""
    text, lesson = COLLECT.read_text(), rf"(teaches {skill} on {skill}) .*"
    text = text.replace(f"skill {skill} is mlp hidden 2", f"skill {skill} is {function}")
    text = text.replace("is genetic population 100", f"is genetic {learner}")
    compiled = compile_source(Source(COLLECT.name, re.sub(lesson, r"\1 for 100000 generations", text)), COLLECT)
    assert compiled.graph is not None, compiled.diagnostics
    found = next(each for each in compiled.graph.lessons if each.skill == skill)
    rollout = Rollout(Policy(compiled.graph, {}), found.task, found.master, [skill])
    rollout.compile()
    return found, rollout


def learn(lesson: Any, rollout: Rollout, seed: int, ticks: float) -> dict[str, Any]:
    """One seed, and what its champion does on the fresh layouts."""
    course = Course(lesson, seed, np.zeros((0, rollout.genome_length), np.float32))
    begun = time.perf_counter()
    state = begin(course)
    for step in side_by_side(course, InThisThread(course, rollout, time.perf_counter), state, lambda: False):
        state = step.state
        if state.ticks >= ticks:
            break
    [skill], champion = rollout.learners, state.now.champion
    counts = rollout.score(champion, [int(word) for word in FRESH_LAYOUTS]).counts[0]
    return {
        "seed": seed,
        "count": float(counts.mean()),
        "error": float(counts.std(ddof=1) / len(counts) ** 0.5),
        "links": skill.function.summary(champion[0], skill.outputs) or f"{champion.size} weights",
        "millions": state.ticks / 1e6,
        "seconds": time.perf_counter() - begun,
    }


def speeds(skill: str, functions: list[str], rounds: int = 5) -> dict[str, float]:
    """The most ticks per second of each of these functions with random weights, in turns."""
    most = dict.fromkeys(functions, 0.0)
    rollouts = {function: prepared(skill, function)[1] for function in functions}
    for number in range(rounds):
        for function, rollout in rollouts.items():
            genomes = np.random.default_rng(number).normal(0, 1, (100, rollout.genome_length)).astype(np.float32)
            begun = time.process_time()
            ticks = rollout.score(genomes, [1, 2]).ticks.sum()
            most[function] = max(most[function], float(ticks / (time.process_time() - begun)))
    return most


def main() -> None:
    """Teach, try, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--skill", default="GoToObject")
    parser.add_argument("--function", default="neat")
    parser.add_argument("--learner", default=LEARNER)
    parser.add_argument("--ticks", type=float, default=60e6)
    parser.add_argument("--seeds", type=int, nargs="+", default=[*range(1, 21)])
    parser.add_argument("--at-least", type=float, default=25.0, help="the count from which a seed has succeeded")
    parser.add_argument("--speed", nargs="+", metavar="FUNCTION", help="compare the speed of these functions alone")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.speed:
        print(json.dumps(speeds(options.skill, options.speed)))
        return
    lesson, rollout = prepared(options.skill, options.function, options.learner)
    runs = []
    for seed in options.seeds:
        runs.append(learn(lesson, rollout, seed, options.ticks))
        if not options.json:
            print(LINE.format(**runs[-1]), flush=True)
    succeeded = sum(run["count"] >= options.at_least for run in runs)
    if options.json:
        print(json.dumps({**vars(options), "succeeded": succeeded, "runs": runs}))
    else:
        print(f"{succeeded} of {len(runs)} seeds reach {options.at_least:g}")


if __name__ == "__main__":
    main()
