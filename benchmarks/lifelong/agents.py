"""Agents that learn tasks one after the other: what each teaches in a lesson, and who plays a task after it.

What an agent takes from one lesson to the next is a dictionary of arrays.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol

import numpy as np
from mindrun.graph.graph import Gate, Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import owners, parts, reachable
from mindrun.numbers.network import FLOAT32, NOTHING, matrices
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from mindrun.train.population import Genomes
from numpy.typing import NDArray

from benchmarks.lifelong.sequence import Stage, TaskSequence, network_on
from benchmarks.lifelong.teaching import FINISH, Anchored, Curve, Effort, Part, Replay, Timed, teach
from mindlang.run.comparison import NEVER

Known = Mapping[str, NDArray[Any]]
NET, NOBODY = "Monolith", np.empty((1, 0), np.float32)  # the weights of the network; the genome where nobody learns
PROBED_RUNS, PROBED_READINGS, PROBE_STEP = 4, 200, np.float32(0.5)  # of a champion's; as far as learning moves a weight
FREED_SHARE, RETRAINED_SHARE = 0.6, 0.3  # of the free weights after a lesson; of a lesson's ticks
ON_THE_JOB_SHARE = 0.4  # of the ticks, in which all skills below learn as well
CHOOSING_LAYOUTS = range(8)  # on which earlier skills try a new task


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


@dataclass(frozen=True, slots=True)
class Hierarchy:
    """The paper's agent: new skills in each lesson; those below stay as they are, but where it learns on the job.

    With `is_alone` those of a written lesson influence none of earlier ones: what the hierarchy is worth.
    """

    of: TaskSequence
    on_the_job: bool = False
    is_alone: bool = False

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        known, spent = self._with_earlier(known, lesson)
        curve, stages, left = Curve(), [*self.of.stages[lesson]], ticks - spent
        if self.on_the_job and lesson in self.of.on_the_job:
            below = owners(reachable(self._graph(known), self.of.master(lesson)))
            stages = [replace(stage, share=stage.share * (1 - ON_THE_JOB_SHARE)) for stage in stages]
            stages.append(Stage(self.of.tasks[lesson], below, ON_THE_JOB_SHARE))
        for stage in stages:
            known, timed = self._taught(known, stage, seed, stage.share * left)
            if stage.task == self.of.tasks[lesson]:
                curve += [(spent + at, count) for at, count in timed.curve]
            spent += timed.ticks
        return Learnt(known, curve, spent)

    def _with_earlier(self, known: Known, lesson: int) -> tuple[Known, int]:
        """What is known, with the earlier skills that do best on a new task and so stand below its own; the ticks.

        They are an array `below TASK` of their places in the graph, the best first.
        """
        many = min(self.of.earlier, lesson)
        if not many or self.is_alone:
            return known, 0
        task, masters = self.of.tasks[lesson], [self.of.master(each) for each in range(lesson)]
        found = [self._rollout(known, task, each).score(NOBODY, CHOOSING_LAYOUTS) for each in masters]
        best = np.argsort([-each.total.mean() for each in found], kind="stable")[:many]
        places = np.array([self.of.graph.skill_numbers[masters[each]] for each in best])
        return {**known, f"below {task}": places}, sum(int(each.ticks.sum()) for each in found)

    def _graph(self, known: Known) -> Graph:
        """The hierarchy, in which the skill of each lesson influences those that were chosen for it."""
        skills, numbers = [*self.of.graph.skills], self.of.graph.skill_numbers
        for lesson, task in enumerate(self.of.tasks):
            places, number = known.get(f"below {task}"), numbers[self.of.master(lesson)]
            own, *others = skills[number].edges
            if self.is_alone:
                others = [replace(e, target=own.target, gate=Gate(NEVER)) if e.output else e for e in others]
            elif places is not None:
                others = [replace(e, target=int(places[e.output - 1])) if e.output else e for e in others]
            skills[number] = replace(skills[number], edges=(own, *others))
        return replace(self.of.graph, skills=tuple(skills))

    def _rollout(self, known: Known, task: str, master: str, learners: tuple[str, ...] = ()) -> Rollout:
        graph = self._graph(known)
        weights = {name: known[name] for name in owners(graph.skills) if name in known}
        return Rollout(Policy(graph, weights), task, master, learners)

    def _taught(self, known: Known, stage: Stage, seed: int, ticks: float) -> tuple[Known, Timed]:
        """What is known after a stage; learners that all are known are finished together."""
        rollout = self._rollout(known, stage.task, stage.learners[0], stage.learners)
        rollout.compile()
        if known.keys() >= {*stage.learners}:
            start, effort = np.concatenate([known[name] for name in stage.learners])[None], Effort(FINISH, ticks)
        else:
            start = np.empty((0, rollout.genome_length), np.float32)
            effort = Effort(self.of.learner, ticks, self.of.attempts)
        champion, timed = teach(rollout, start, seed, effort)
        return {**known, **parts(self.of.graph, stage.learners, champion[0])}, timed

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        master = self.of.master(task)
        needed = owners(reachable(self._graph(known), master))
        return (self._rollout(known, self.of.tasks[task], master), NOBODY) if known.keys() >= {*needed} else None

    def weights(self, known: Known) -> int:
        return sum(len(known[name]) for name in owners(self.of.graph.skills) if name in known)


@dataclass(frozen=True, slots=True)
class Monolith:
    """One network for everything, which goes on from lesson to lesson."""

    of: TaskSequence

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        champion, timed = teach(self.scorer(known, lesson), self.start(known), seed, Effort(self.of.learner, ticks))
        return Learnt(self.after(known, lesson, champion[0]), timed.curve, timed.ticks)

    def start(self, known: Known) -> Genomes:
        """The weights [0 or 1, weights] with which a lesson begins."""
        return known[NET][None] if NET in known else np.empty((0, network_on(self.of, 0).genome_length), np.float32)

    def scorer(self, known: Known, lesson: int) -> Any:
        """What scores the genomes of a lesson."""
        return network_on(self.of, lesson)

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        """What is known after a lesson that ended with these weights."""
        return {**known, NET: weights}

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        return network_on(self.of, task), known[NET][None]

    def weights(self, known: Known) -> int:
        return len(known[NET])


class Replaying(Monolith):
    """The network on half of the layouts of its task, and on half of those of earlier tasks."""

    __slots__ = ()

    def scorer(self, known: Known, lesson: int) -> Any:
        rollouts = [network_on(self.of, task) for task in range(lesson + 1)]
        return Replay(rollouts[-1], rollouts[:-1], self.of.good[: lesson + 1]) if lesson else rollouts[0]


@dataclass(frozen=True, slots=True)
class Anchoring(Monolith):
    """The network that pays for each change of weights on which what it did in earlier lessons depended (as EWC).

    Of all earlier lessons one anchor is kept: their importance added up, and the mean of their weights by it. What is
    paid differs from a sum over all lessons by what no change of weights changes.
    """

    strength: float = 0.01  # the best of ANCHOR_STRENGTHS after two lessons, with the seeds 101 and 102

    def scorer(self, known: Known, lesson: int) -> Any:
        network = network_on(self.of, lesson)
        points = self.strength * self.of.good[lesson]
        return Anchored(network, known["anchor"], known["importance"], points) if lesson else network

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        steps = np.full_like(weights, PROBE_STEP)
        found = importance(self.of, network_on(self.of, lesson), weights, steps) / PROBE_STEP**2
        whole = known.get("importance", np.float32(0)) + found
        part = np.divide(found, whole, out=np.zeros_like(found), where=whole > 0)
        anchor = known.get("anchor", np.zeros_like(weights))
        return {NET: weights, "anchor": anchor + part * (weights - anchor), "importance": whole}


@dataclass(frozen=True, slots=True)
class Masked:
    """The network of which each task keeps weights for itself (as PackNet): it has to be told the task.

    After most of a lesson those of its free weights without which the outputs change least become 0 and free for later
    ones; the others learn a little longer, and stay. Task number k acts with those of the tasks up to it. (PackNet asks
    for the smallest, which says little of networks that no gradient has taught.)
    """

    of: TaskSequence

    def learn(self, known: Known, lesson: int, seed: int, ticks: float) -> Learnt:
        rollout = network_on(self.of, lesson)
        nothing = np.zeros(rollout.genome_length, np.float32)
        net, owner = known.get(NET, nothing).copy(), known.get("owner", nothing.astype(np.int64)).copy()
        free = np.flatnonzero(owner == 0)
        start = net[free][None] if lesson else np.empty((0, len(free)), np.float32)
        first = Effort(self.of.learner, (1 - RETRAINED_SHARE) * ticks)
        champion, begun = teach(Part(rollout, net, free), start, seed, first)
        net[free] = champion[0]
        needed = importance(self.of, rollout, net, np.where(owner == 0, -net, np.float32(0)))[free]
        freed = 1 - 1 / (len(self.of.tasks) - lesson) if self.of.is_shared_evenly else FREED_SHARE
        least = free[np.argsort(needed, kind="stable")[: round(freed * len(free))]]
        owner[free] = lesson + 1
        owner[least], net[least] = 0, 0.0
        own = np.flatnonzero(owner == lesson + 1)
        rest = Effort(self.of.learner, max(1.0, ticks - begun.ticks))
        champion, timed = teach(Part(rollout, net, own), net[own][None], seed, rest)
        net[own] = champion[0]
        curve = begun.curve + [(begun.ticks + at, count) for at, count in timed.curve]
        return Learnt({NET: net, "owner": owner}, curve, begun.ticks + timed.ticks)

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        acts = (known["owner"] > 0) & (known["owner"] <= task + 1)
        return network_on(self.of, task), np.where(acts, known[NET], np.float32(0))[None]

    def weights(self, known: Known) -> int:
        return int((known["owner"] > 0).sum())


class OnePerTask(Monolith):
    """A network for each task, from scratch."""

    __slots__ = ()

    def start(self, known: Known) -> Genomes:
        return np.empty((0, network_on(self.of, 0).genome_length), np.float32)

    def after(self, known: Known, lesson: int, weights: NDArray[np.float32]) -> Known:
        return {**known, self.of.tasks[lesson]: weights}

    def player(self, known: Known, task: int) -> tuple[Rollout, Genomes] | None:
        weights = known.get(self.of.tasks[task])
        return None if weights is None else (network_on(self.of, task), weights[None])

    def weights(self, known: Known) -> int:
        return sum(map(len, known.values()))


def importance(
    of: TaskSequence, rollout: Rollout, weights: NDArray[np.float32], steps: NDArray[np.float32]
) -> NDArray[np.float32]:
    """The mean squared change of a network's outputs where each of its weights alone is moved by its step.

    Over readings of its runs, of all outputs together after the clamp, which most of them are beyond.
    """
    skill = next(skill for skill in of.graph.skills if skill.name == of.net)
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


ALONE = "skills alone"  # where lessons are written, with skills of their own
AGENTS: dict[str, Callable[[TaskSequence], Agent]] = {
    "hierarchy": Hierarchy,
    "hierarchy on the job": partial(Hierarchy, on_the_job=True),
    "monolith": Monolith,
    "monolith, replay": Replaying,
    "monolith, anchored": Anchoring,
    "monolith, masked": Masked,
    "one per task": OnePerTask,
    ALONE: partial(Hierarchy, is_alone=True),
}
ANCHOR_STRENGTHS = 0.001, 0.01, 0.1, 1.0  # of anchors, to choose one of them with seeds that are not reported
CANDIDATES = {f"anchored {each:g}": partial(Anchoring, strength=each) for each in ANCHOR_STRENGTHS}
