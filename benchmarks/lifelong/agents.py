"""Agents that learn eight tasks one after the other: what each teaches in a lesson, and who plays a task after it.

What an agent takes from one lesson to the next is a dictionary of arrays.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Protocol

import numpy as np
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes, parts, reachable
from mindrun.graph.weights import learners as taught_with
from mindrun.numbers.network import FLOAT32, NOTHING, matrices
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from mindrun.train.population import Genomes
from numpy.typing import NDArray

from benchmarks.lifelong.teaching import FINISH, Anchored, Curve, Effort, Part, Replay, Timed, teach
from benchmarks.workloads import COLLECT, graph_of
from mindlang.compiler.compile import load

Known = Mapping[str, NDArray[Any]]
NET = "Monolith"
# The tasks in their order; the score that a good skill has, to compare those of several tasks; and what counts as done:
# what the paper asks of an attempt (examples/collect/paper), for the last the best that it reports (Table 3).
GOOD_SCORES = {
    "GoToObject": 350.0,
    "GoToDropZone": 350.0,
    "Avoid": 1000.0,
    "GoToObject+Avoid": 50.0,
    "GoToDropZone+Avoid": 50.0,
    "Collect": 150.0,
    "GoToPower+Avoid": 50.0,
    "CollectWithPower": 120.0,
}
DONE_COUNTS = (25.0, 25.0, 100.0, 5.0, 5.0, 4.63, 5.0, 3.99)
TASKS = tuple(GOOD_SCORES)
PROBED_RUNS, PROBED_READINGS, PROBE_STEP = 4, 200, np.float32(0.5)  # of a champion's; as far as learning moves a weight
FREED_SHARE, RETRAINED_SHARE = 0.6, 0.3  # of the free weights after a lesson; of a lesson's ticks


@dataclass(frozen=True, slots=True)
class Learnt:
    """What came of a lesson: what is known after it, how it was learnt, and in how many ticks."""

    known: Known
    curve: Curve
    ticks: int


class Agent(Protocol):
    """An agent; lessons and tasks count from 0."""

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        """Be taught a lesson with what is known before it."""

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        """A rollout of a task, and the genome [1, weights] to score in it; None where nobody could play it yet."""

    def weights(self, known: Known) -> int:
        """The number of weights with which it acts."""


@cache
def graph() -> Graph:
    """The hierarchy and the network, compiled."""
    return graph_of(load(COLLECT.with_name("lifelong.mind")))


@cache
def network_on(task: int) -> Rollout:
    """The network alone on a task."""
    rollout = Rollout(Policy(graph(), {}), TASKS[task], NET, [NET])
    rollout.compile()
    return rollout


@dataclass(frozen=True, slots=True)
class Stage:
    """A part of a hierarchy's lesson: a skill learns on a task, in a share of the ticks."""

    skill: str
    task: str
    share: float = 1.0
    with_subskills: bool = False


STAGES: tuple[tuple[Stage, ...], ...] = tuple((Stage(task, task),) for task in TASKS)
STAGES = (*STAGES[:6], (Stage("GoToPower", "GoToPower", 0.3), Stage(TASKS[6], TASKS[6], 0.7)), STAGES[7])
ON_THE_JOB_SHARE = 0.4  # of the ticks, in which all skills below learn as well


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The paper's agent: a new skill in each lesson; those below it stay as they are, but `on_the_job` after some."""

    on_the_job: frozenset[int] = frozenset()
    attempts: int = 3

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        stages = STAGES[lesson]
        if lesson in self.on_the_job:
            stages = (
                *(replace(stage, share=stage.share * (1 - ON_THE_JOB_SHARE)) for stage in stages),
                Stage(TASKS[lesson], TASKS[lesson], ON_THE_JOB_SHARE, with_subskills=True),
            )
        curve, spent = Curve(), 0
        for stage in stages:
            known, timed = self._taught(known, stage, seed, stage.share * ticks)
            if stage.task == TASKS[lesson]:
                curve += [(spent + at, count) for at, count in timed.curve]
            spent += timed.ticks
        return Learnt(known, curve, spent)

    def _taught(self, known: Known, stage: Stage, seed: int, ticks: float) -> tuple[Known, Timed]:
        lesson = Lesson("", stage.skill, stage.task, stage.skill, 1, False, stage.with_subskills, FINISH)
        names = taught_with(graph(), lesson)
        rollout = Rollout(Policy(graph(), known), stage.task, stage.skill, names)
        rollout.compile()
        start = np.empty((0, rollout.genome_length), np.float32)
        effort = Effort(ticks, self.attempts)
        if stage.with_subskills:
            start, effort = np.concatenate([known[name] for name in names])[None], Effort(ticks, learner=FINISH)
        champion, timed = teach(rollout, start, seed, effort)
        return {**known, **parts(graph(), names, champion[0])}, timed

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        needed = {skill.owner for skill in reachable(graph(), TASKS[task]) if genes(skill)}
        if not needed <= known.keys():
            return None
        return Rollout(Policy(graph(), known), TASKS[task], TASKS[task]), np.empty((1, 0), np.float32)

    def weights(self, known: Known) -> int:
        return sum(map(len, known.values()))


@dataclass(frozen=True, slots=True)
class Monolith:
    """One network for everything, which goes on from lesson to lesson."""

    attempts: int = 1

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        scorer = self.scorer(known, lesson)
        champion, timed = teach(scorer, self.start(known), seed, Effort(ticks, self.attempts))
        return Learnt(self.after(known, lesson, champion[0]), timed.curve, timed.ticks)

    def start(self, known: Known) -> Genomes:
        """The weights [0 or 1, weights] with which a lesson begins."""
        return known[NET][None] if NET in known else np.empty((0, network_on(0).genome_length), np.float32)

    def scorer(self, known: Known, lesson: int) -> Any:
        """What scores the genomes of a lesson."""
        return network_on(lesson)

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        """What is known after a lesson that ended with these weights."""
        return {**known, NET: weights}

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        return network_on(task), known[NET][None]

    def weights(self, known: Known) -> int:
        return len(known[NET])


class Replaying(Monolith):
    """The network on half of the layouts of its task, and on half of those of earlier tasks."""

    __slots__ = ()

    def scorer(self, known: Known, lesson: int) -> Any:
        rollouts, good = [network_on(task) for task in range(lesson + 1)], [*GOOD_SCORES.values()]
        return Replay(rollouts[-1], rollouts[:-1], good[: lesson + 1]) if lesson else rollouts[0]


@dataclass(frozen=True, slots=True)
class Anchoring(Monolith):
    """The network that pays for each change of weights on which what it did in earlier lessons depended (as EWC)."""

    strength: float = 0.01  # the best of ANCHOR_STRENGTHS after two lessons, with the seeds 101 and 102

    def scorer(self, known: Known, lesson: int) -> Any:
        anchors = [(known[f"weights {number}"], known[f"importance {number}"]) for number in range(lesson)]
        return Anchored(network_on(lesson), anchors, self.strength * GOOD_SCORES[TASKS[lesson]])

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        found = importance(network_on(lesson), weights, np.full_like(weights, PROBE_STEP)) / PROBE_STEP**2
        return {**known, NET: weights, f"weights {lesson}": weights, f"importance {lesson}": found}


@dataclass(frozen=True, slots=True)
class Masked:
    """The network of which each task keeps weights for itself (as PackNet): it has to be told the task.

    After most of a lesson those of its free weights without which the outputs change least become 0 and free for later
    ones; the others learn a little longer, and stay. Task number k acts with those of the tasks up to it. (PackNet asks
    for the smallest, which says little of networks that no gradient has taught.)
    """

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        rollout = network_on(lesson)
        nothing = np.zeros(rollout.genome_length, np.float32)
        net, owner = known.get(NET, nothing).copy(), known.get("owner", nothing.astype(np.int64)).copy()
        free = np.flatnonzero(owner == 0)
        start = net[free][None] if lesson else np.empty((0, len(free)), np.float32)
        first = Effort((1 - RETRAINED_SHARE) * ticks)
        champion, begun = teach(Part(rollout, net, free), start, seed, first)
        net[free] = champion[0]
        needed = importance(rollout, net, np.where(owner == 0, -net, np.float32(0)))[free]
        least = free[np.argsort(needed, kind="stable")[: round(FREED_SHARE * len(free))]]
        owner[free] = lesson + 1
        owner[least], net[least] = 0, 0.0
        own = np.flatnonzero(owner == lesson + 1)
        champion, timed = teach(Part(rollout, net, own), net[own][None], seed, Effort(max(1.0, ticks - begun.ticks)))
        net[own] = champion[0]
        curve = begun.curve + [(begun.ticks + at, count) for at, count in timed.curve]
        return Learnt({NET: net, "owner": owner}, curve, begun.ticks + timed.ticks)

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        acts = (known["owner"] > 0) & (known["owner"] <= task + 1)
        return network_on(task), np.where(acts, known[NET], np.float32(0))[None]

    def weights(self, known: Known) -> int:
        return int((known["owner"] > 0).sum())


class OnePerTask(Monolith):
    """A network for each task, from scratch."""

    __slots__ = ()

    def start(self, known: Known) -> Genomes:
        return np.empty((0, network_on(0).genome_length), np.float32)

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        return {**known, TASKS[lesson]: weights}

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        return (network_on(task), known[TASKS[task]][None]) if TASKS[task] in known else None

    def weights(self, known: Known) -> int:
        return sum(map(len, known.values()))


def importance(rollout: Rollout, weights: NDArray[np.float32], steps: NDArray[np.float32]) -> NDArray[np.float32]:
    """The mean squared change of a network's outputs where each of its weights alone is moved by its step.

    Over readings of its runs, of all outputs together after the clamp, which most of them are beyond.
    """
    skill = next(skill for skill in graph().skills if skill.name == NET)
    shapes = skill.function.matrix_shapes(len(skill.inputs), skill.outputs)
    chunks = [chunk.readings for seed in range(PROBED_RUNS) for chunk in trace(rollout, seed, weights).chunks]
    readings = np.concatenate(chunks)
    chosen = np.linspace(0, len(readings) - 1, PROBED_READINGS).astype(int)
    inputs = np.ascontiguousarray(readings[chosen][:, skill.inputs])

    def outputs(genome: NDArray[np.float32]) -> NDArray[np.float32]:
        sent: NDArray[np.float32] = skill.function.forward(FLOAT32, matrices(genome, shapes), inputs, NOTHING)[0]
        return np.clip(sent, 0, 1)

    before, found = outputs(weights), np.zeros(len(weights), np.float32)
    for place in np.flatnonzero(steps):
        moved = weights.copy()
        moved[place] += steps[place]
        found[place] = ((outputs(moved) - before) ** 2).sum(axis=1).mean()
    return found


AGENTS: dict[str, Agent] = {
    "hierarchy": Hierarchy(),
    "hierarchy on the job": Hierarchy(frozenset({5, 7})),
    "monolith": Monolith(),
    "monolith, replay": Replaying(),
    "monolith, anchored": Anchoring(),
    "monolith, masked": Masked(),
    "one per task": OnePerTask(),
}
ANCHOR_STRENGTHS = 0.001, 0.01, 0.1, 1.0  # of anchors, to choose one of them with seeds that are not reported
CANDIDATES: dict[str, Agent] = {f"anchored {each:g}": Anchoring(strength=each) for each in ANCHOR_STRENGTHS}
