"""The sequences by their names: the paper's eight tasks, a hundred that are drawn, and twelve after CRoSS."""

from collections.abc import Callable
from functools import cache

from mindrun.kinds.learners import Genetic

from benchmarks.lifelong.cross import cross
from benchmarks.lifelong.generated import hundred
from benchmarks.lifelong.sequence import Stage, TaskSequence
from benchmarks.workloads import COLLECT, graph_of
from mindlang.compiler.compile import load

# The tasks; the score that a good skill has, to compare those of several tasks; and what counts as done: what the paper
# asks of an attempt (examples/collect/paper), for the last the best that it reports (Table 3).
EIGHT = {
    "GoToObject": (350.0, 25.0),
    "GoToDropZone": (350.0, 25.0),
    "Avoid": (1000.0, 100.0),
    "GoToObject+Avoid": (50.0, 5.0),
    "GoToDropZone+Avoid": (50.0, 5.0),
    "Collect": (150.0, 4.63),
    "GoToPower+Avoid": (50.0, 5.0),
    "CollectWithPower": (120.0, 3.99),
}


def eight(seed: int) -> TaskSequence:
    """The paper's lessons, whatever the seed."""
    stages: dict[str, tuple[Stage, ...]] = {task: (Stage(task, (task,)),) for task in EIGHT}
    stages["GoToPower+Avoid"] = (
        Stage("GoToPower", ("GoToPower",), 0.3),
        Stage("GoToPower+Avoid", ("GoToPower+Avoid",), 0.7),
    )
    good, done = zip(*EIGHT.values(), strict=True)
    return TaskSequence(
        graph_of(load(COLLECT.with_name("lifelong.mind"))),
        net="Monolith",
        tasks=tuple(EIGHT),
        good=good,
        done=done,
        stages=tuple(stages.values()),
        ticks=60e6,
        attempts=3,
        learner=Genetic(octaves=2, short=0.1),
        on_the_job=frozenset({5, 7}),
    )


SEQUENCES: dict[str, Callable[[int], TaskSequence]] = {"eight": eight, "hundred": hundred, "cross": cross}


@cache
def sequence(drawn: tuple[str, int]) -> TaskSequence:
    """The sequence of a name, drawn with a seed where it is drawn."""
    name, seed = drawn
    return SEQUENCES[name](seed)
