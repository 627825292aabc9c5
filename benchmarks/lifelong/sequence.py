"""A sequence of tasks for one life: what is taught one after the other, and by what it is measured."""

from dataclasses import dataclass
from functools import cache

from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.kinds.learners import Learner
from mindrun.sim.rollout import Rollout


@dataclass(frozen=True, slots=True)
class Stage:
    """A part of a hierarchy's lesson: `learners` learn on a task, in a share of the ticks; the first is in charge."""

    task: str
    learners: tuple[str, ...]
    share: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class TaskSequence:
    """The tasks of a life in their order, each with the `good` score of a skill there, and the count that is `done`.

    `graph` has the hierarchy and `net`, a network alone. A hierarchy is taught the `stages` of each lesson, in so many
    `attempts` with `ticks` in all; in the lessons `on_the_job` all below learns as well. Where `earlier` skills
    stand below each lesson's, the agent chooses them. All tasks are tried after every `looks_apart` lessons. A masked
    network gives each lesson a part of its weights: most of those left, or where these are shared evenly, the same.
    What counts as 1 is the best of all agents after a lesson, or else one network for that task alone, and no less than
    what is done.
    """

    graph: Graph
    net: str
    tasks: tuple[str, ...]
    good: tuple[float, ...]
    done: tuple[float, ...]
    stages: tuple[tuple[Stage, ...], ...]
    ticks: float
    learner: Learner
    attempts: int = 1
    on_the_job: frozenset[int] = frozenset()
    earlier: int = 0
    looks_apart: int = 1
    is_shared_evenly: bool = False
    is_best_of_all: bool = False

    def master(self, lesson: int) -> str:
        """The skill that a lesson teaches, in charge of its task."""
        return self.stages[lesson][-1].learners[0]

    def is_looked_at(self, lesson: int) -> bool:
        """True if all tasks are tried after this lesson."""
        return (lesson + 1) % self.looks_apart == 0


@cache
def network_on(of: TaskSequence, task: int) -> Rollout:
    """The network alone on a task."""
    rollout = Rollout(Policy(of.graph, {}), of.tasks[task], of.net, [of.net])
    rollout.compile()
    return rollout
