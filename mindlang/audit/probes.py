"""Probes: simple policies that show what a task pays. All run on the same layouts, each line's sum is known exactly."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import Literal

import numpy as np
from mindrun.graph.graph import Edge, Gate, Graph, Memory, Skill, Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.skill_sets import learners, owners, reachable
from mindrun.graph.weights import parts
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.memory import Cell
from mindrun.numbers.expression import Program
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.train.population import Genomes
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.run.chosen_task import master_of
from mindlang.run.setup import NO_GENOME, layouts

Group = Literal["still", "moving", "to and fro", "random", "skill", "found"]
Values = NDArray[np.float64]

PROBE, TURN = "AuditProbe", "audit_turn"  # a skill and a memory, which no mind has by these names
PROBE_RUNS, OUTSIDE_RUNS = 40, 3  # layouts; of a world that is an environment, which is slow
RANDOM_GENOMES, OUTSIDE_GENOMES = 200, 20  # genomes
RANDOM_TICKS = 40_000_000  # of all genomes together, which see fewer layouts where a run is long
MIN_LAYOUTS = 4
MAX_CORNERS = 27  # three commands of three actuators
OFF_NEUTRAL = 0.01  # command: as of 2 % of a wheel's thrust
ARC_COMMAND = 0.05  # command: less of one actuator than of all others
TO_AND_FRO_TICKS = 50  # there and back


@dataclass(frozen=True, slots=True)
class Probe:
    """Policies under the master of their graph: one, or one for each of the `genomes` of its `learners`."""

    name: str
    group: Group
    policy: Policy
    learners: tuple[str, ...] = ()
    genomes: Genomes = field(default_factory=lambda: NO_GENOME)

    @property
    def master(self) -> str:
        return self.policy.graph.master

    def rollout(self, task: str, folder: Path, workers: int = 1) -> Rollout:
        """The probe on a task, in the simulator."""
        of = self.policy, task, self.master, self.learners
        return rollout_for(*of, procedures=folder, workers=workers)

    def single(self, number: int) -> "Probe":
        """The probe of one of its genomes, whose weights are in its policy."""
        if not self.learners:
            return self
        learnt = parts(self.policy.graph, self.learners, self.genomes[number])
        policy = replace(self.policy, weights={**self.policy.weights, **learnt})
        name = f"{self.name} {number + 1}" if len(self.genomes) > 1 else self.name
        return Probe(name, self.group, policy)


@dataclass(frozen=True, slots=True)
class Evidence:
    """What policies [policies] came to on a task in the mean of their runs: `lines` [policies, reward lines] are paid,
    `events` [policies, events] happen, `success` is the share of runs. Left out is who had a fault.
    """

    task: Task
    origins: tuple[tuple[Probe, int], ...]
    scores: Values
    lines: Values
    events: Values
    success: Values

    def of(self, *groups: Group) -> NDArray[np.bool_]:
        """A mask of the policies of some groups."""
        return np.array([probe.group in groups for probe, _ in self.origins], np.bool_)

    def probe(self, row: int) -> Probe:
        """The probe of a row, alone."""
        probe, number = self.origins[row]
        return probe.single(number)

    def __add__(self, other: "Evidence") -> "Evidence":
        arrays = (
            np.concatenate([getattr(self, each), getattr(other, each)])
            for each in ("scores", "lines", "events", "success")
        )
        return Evidence(self.task, self.origins + other.origins, *arrays)


def evidence(task: Task, probe: Probe, scores: Scores) -> Evidence:
    lines = scores.by_line[:, :, : len(task.rewards)].mean(axis=1)
    success = np.asarray(succeeded(task, scores), np.float64).mean(axis=1)
    good = np.flatnonzero(~scores.faults.any(axis=1) & np.isfinite(scores.total).all(axis=1))
    found = (scores.total.mean(axis=1), lines, scores.by_event.mean(axis=1)[:, : len(task.events)], success)
    return Evidence(task, tuple((probe, int(row)) for row in good), *(each[good] for each in found))


def tried(
    probes: Iterable[Probe],
    task: Task,
    folder: Path,
    seed: int,
    workers: int,
    ready: Callable[[Rollout], None] = lambda rollout: None,
) -> Evidence:
    """All probes on the same layouts; `ready` is told of each simulator before it runs. One in Python is left out."""
    found: Evidence | None = None
    for probe in probes:
        rollout = probe.rollout(task.name, folder, workers)
        if rollout.procedures.slow:
            continue
        ready(rollout)
        seen = evidence(task, probe, rollout.score(probe.genomes, probe_layouts(task, probe, seed)))
        found = seen if found is None else found + seen
    assert found is not None
    return found


def probe_layouts(task: Task, probe: Probe, seed: int) -> list[int]:
    """The seeds of a probe's runs: the same for all, the first of them where there are many genomes."""
    most = OUTSIDE_RUNS if task.scene.environment else PROBE_RUNS
    fewer = RANDOM_TICKS // (len(probe.genomes) * task.ticks)
    return layouts(seed, most)[: most if len(probe.genomes) == 1 else max(MIN_LAYOUTS, fewer)]


def probes_of(policy: Policy, task: Task, seed: int) -> Iterator[Probe]:
    """All probes of a task; `policy` has the weights of all skills that have any."""
    yield from command_probes(policy)
    yield from skill_probes(policy)
    yield from random_probes(policy, task, seed)


def skill_probes(policy: Policy) -> Iterator[Probe]:
    """Every skill as master that has all the weights it needs."""
    for skill in policy.graph.skills:
        if all(name in policy.weights for name in owners(reachable(policy.graph, skill.name))):
            yield Probe(skill.name, "skill", _under(policy, skill.name))


def random_probes(policy: Policy, task: Task, seed: int) -> Iterator[Probe]:
    """Random genomes of what the task's first lesson teaches, and of all that has no weights below its master."""
    count = OUTSIDE_GENOMES if task.scene.environment else RANDOM_GENOMES
    if (found := learning_probe(policy, task)).learners:
        rng = np.random.default_rng(seed)
        skills = {skill.name: skill for skill in policy.graph.skills}
        each = [skills[name] for name in found.learners]
        genomes = [skill.function.draw(len(skill.inputs), skill.outputs, count, rng) for skill in each]
        yield replace(found, genomes=np.concatenate(genomes, axis=1))


def learning_probe(policy: Policy, task: Task) -> Probe:
    """The learners of a task under their master, without genomes; without learners where nothing learns."""
    graph = policy.graph
    lesson = next((each for each in graph.lessons if each.task == task.name), None)
    master = lesson.master if lesson else master_of(graph, task, None)
    below = owners(reachable(graph, master))
    taught = learners(graph, lesson) if lesson else ()
    missing = tuple(name for name in below if name not in policy.weights and name not in taught)
    return Probe("random", "random", _under(policy, master), taught + missing or below)


def command_probes(policy: Policy) -> Iterator[Probe]:
    """Constant commands, the one at rest first, and all that moves to and fro."""
    graph = policy.graph
    rest = tuple(actuator.kind.neutral for actuator in graph.actuators)
    yield Probe("at rest", "still", _driven(policy, rest))
    for commands in dict.fromkeys(_commands(graph, rest)):
        moves = any(rest[i] != commands[i] for i in _moving(graph))
        name = ", ".join(f"{part.name} {value:g}" for part, value in zip(graph.actuators, commands, strict=True))
        if commands != rest:
            yield Probe(name, "moving" if moves else "still", _driven(policy, commands))
    if moving := _moving(graph):
        there = tuple(1.0 if i in moving else command for i, command in enumerate(rest))
        yield Probe("to and fro", "to and fro", _driven(policy, there, TO_AND_FRO_TICKS))


def _moving(graph: Graph) -> list[int]:
    """The actuators that move something: the body, or what stands in for it in an environment."""
    return [i for i, each in enumerate(graph.actuators) if each.kind.moves_body or each.kind.slot is not None]


def _commands(graph: Graph, rest: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """The corners and centres of all commands, then a little off neutral, and arcs."""
    levels = [sorted({0.0, neutral, 1.0}) for neutral in rest]
    moving = _moving(graph)

    def with_moving(commands: Sequence[float]) -> tuple[float, ...]:
        return tuple(commands[i] if i in moving else rest[i] for i in range(len(rest)))

    if np.prod([len(each) for each in levels]) <= MAX_CORNERS:
        yield from product(*levels)
    else:
        for i, level in enumerate(levels):
            yield from ((*rest[:i], value, *rest[i + 1 :]) for value in level)
        yield from (with_moving([value] * len(rest)) for value in (0.0, 1.0))
    for off in (OFF_NEUTRAL, -OFF_NEUTRAL):
        yield with_moving([min(1.0, max(0.0, command + off)) for command in rest])
    for aside in moving if len(moving) > 1 else ():
        yield with_moving([1.0 - ARC_COMMAND * (i == aside) for i in range(len(rest))])


def _under(policy: Policy, master: str) -> Policy:
    return replace(policy, graph=replace(policy.graph, master=master))


def _driven(policy: Policy, commands: Sequence[float], period: int = 0) -> Policy:
    """The mind under a skill that sends these commands and nothing else; with a period what moves goes back as often.

    The way back is the command 1 − v. The turn is counted by a memory behind all others, so that nothing else moves.
    """
    graph = policy.graph
    memories, edges = graph.memories, list[Edge]()
    for i, value in enumerate(commands):
        back = Gate(_before(graph.width, 0.5), (("number", 1.0 - value),)) if period and i in _moving(graph) else None
        edges.append(Edge("actuator", i, None, (("number", float(value)),), back))
    if period:
        memories = (*memories, Memory(TURN, Cell(decay=0.0), graph.width))
        more: Program = (("reading", graph.width), ("number", 1.0 / period), ("+", 0))
        last = 1.0 - 1.5 / period
        ends = Gate(_before(graph.width, last), (("number", 0.0),))
        edges.append(Edge("memory", len(graph.memories), None, more, ends))
    skill = Skill(PROBE, Rule(), (), tuple(edges))
    return Policy(replace(graph, memories=memories, skills=(*graph.skills, skill), master=PROBE), policy.weights)


def _before(reading: int, value: float) -> Program:
    """The condition that a reading is below a value."""
    return ("reading", reading), ("number", value), ("<", 0)
