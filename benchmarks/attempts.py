"""How often lessons succeed: python benchmarks/attempts.py [--curriculum Quick] [--seeds 10] [SKILL…].

Every seed teaches the lesson from scratch as the curriculum says, subskills as in the lock; the lesson has succeeded if
what it keeps counts as much on 100 fresh layouts as examples/collect/paper asks of an attempt.
"""

import argparse
import sys
import time

import numpy as np
from mindrun.cores import cores
from mindrun.graph import Graph, Lesson
from mindrun.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.train.lesson import teach
from mindrun.train.lesson_state import Course, begin

from benchmarks.learning import FRESH_LAYOUTS
from benchmarks.workloads import COLLECT, collect

sys.path.append(str(COLLECT.parent / "paper"))
from protocol import SUCCESS

LINE = "{skill:<20} {succeeded:>2} of {seeds} count at least {least:g}: {counts}; {seconds:.0f} s each"


def count(lesson: Lesson, rollout: Rollout, seed: int) -> float:
    """What a lesson taught from a seed counts in a run, on the mean over the fresh layouts."""
    course = Course(lesson, seed, np.zeros((0, rollout.genome_length), np.float32))
    *_, (state, _) = teach(course, rollout, begin(course), time.perf_counter)
    return float(rollout.score(state.kept, [int(word) for word in FRESH_LAYOUTS]).counts.mean())


def chosen(graph: Graph, curriculum: str, skills: list[str]) -> list[Lesson]:
    """The lessons of a curriculum that teach these skills, or all of which it is known when they have succeeded."""
    return [
        lesson
        for lesson in graph.lessons
        if lesson.curriculum == curriculum and lesson.name in SUCCESS and lesson.skill in (skills or SUCCESS)
    ]


def main() -> None:
    """Teach, try, count."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("skills", nargs="*", metavar="SKILL", choices=[*SUCCESS, []])
    parser.add_argument("--curriculum", default="Quick")
    parser.add_argument("--seeds", type=int, default=10)
    options = parser.parse_args()
    graph, weights, _ = collect()
    for lesson in chosen(graph, options.curriculum, options.skills):
        rollout = Rollout(Policy(graph, weights), lesson.task, lesson.master, [lesson.skill], workers=cores())
        rollout.compile()
        start = time.perf_counter()
        counts = [count(lesson, rollout, seed) for seed in range(1, options.seeds + 1)]
        print(
            LINE.format(
                skill=lesson.skill,
                succeeded=sum(found >= SUCCESS[lesson.skill] for found in counts),
                seeds=options.seeds,
                least=SUCCESS[lesson.skill],
                counts=" ".join(f"{found:.1f}" for found in counts),
                seconds=(time.perf_counter() - start) / options.seeds,
            ),
            flush=True,
        )


if __name__ == "__main__":
    main()
