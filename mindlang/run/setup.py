"""A run of a task set up: who is in charge, with which weights; and many such runs made, a slice after the other."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.graph.graph import Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.skill_sets import genes, masters_of, owners, reachable
from mindrun.graph.tasks import is_one_world, masters_in
from mindrun.processors import cpu_seconds
from mindrun.terminal.command_line import command_line

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import listed
from mindlang.executors.jobs import Block, JobScorer, empty_scores, write_scores
from mindlang.limits import RUN_BOUNDS, SEED_BOUNDS, bounded_int
from mindlang.lock.status import ReadyMind, make_ready
from mindlang.run.chosen_task import SetupError, master_of, robot_of, task_of
from mindlang.run.edge_flow import EdgeFlows, ReadingsAndInfluence, edge_flows

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout

NO_GENOME = np.zeros((1, 0), np.float32)  # the genome where nobody learns
SLICE_RUNS = 1 << 16  # that are begun together, so that memory is for their results alone


@dataclass(frozen=True, slots=True)
class RunSetup:
    """A task, the master in charge of it, and a mind that is ready to run; `note` says why it is this task.

    Of several robots in its world one is watched, by its number from 0 on: what is written down of a run is its mind,
    and the master is its own. That of the first robot is the `first`, where it may be another.
    """

    task: Task
    master: str
    ready: ReadyMind
    folder: Path
    note: str = ""
    robot: int = 0
    first: str = ""

    def watching(self, robot: int) -> "RunSetup":
        """The run seen through another robot of its world; SetupError where there is no such robot."""
        first = self.first or self.master
        master = masters_in(self.task, first)[robot_of(self.task, robot)]
        return replace(self, robot=robot, master=master, first=first)

    @property
    def mind(self) -> ReadyMind:
        """The mind of the robot that is watched: its master, and the weights of all below; none of other robots'."""
        policy = self.ready.policy
        if len(masters_of(self.task, self.first or self.master)) == 1:
            return self.ready
        weights = {name: policy.weights[name] for name in owners(reachable(policy.graph, self.master))}
        return replace(self.ready, policy=Policy(replace(policy.graph, master=self.master), weights))

    @property
    def is_one_world(self) -> bool:
        """True if nothing of the task is drawn, so that all of its runs are one."""
        return is_one_world(self.ready.policy.graph, self.task, self.first or self.master)

    @property
    def world_notes(self) -> list[str]:
        said = f"nothing is drawn in {self.task.name}, so that one run is made, and any other would be the same"
        return [f"1 world: {said}"] if self.is_one_world else []

    def layouts(self, seed: int, runs: int) -> list[int]:
        """The seeds of so many runs, the first alone where there is one world; MindError where these are none."""
        return layouts(seed, runs)[: 1 if self.is_one_world else None]

    def notes(self, rollout: "Rollout", *more: str) -> list[str]:
        """Notes for the user on runs that have been made."""
        return [*self.ready.notes, *self.world_notes, *rollout.notes, *more]

    def with_policy(self, policy: Policy) -> "RunSetup":
        """The task as a policy of the same skills has it, with that policy in the place of this one."""
        task = next(each for each in policy.graph.tasks if each.name == self.task.name)
        return replace(self, task=task, ready=replace(self.ready, policy=policy))

    def flows(self, run: ReadingsAndInfluence) -> EdgeFlows:
        """The flows of a run under the master; WeightsError or ProcedureError where a skill cannot think."""
        policy = self.ready.policy
        sources = procedure_sources(policy.graph, self.folder, self.master)
        return edge_flows(policy, sources, self.master, run)

    def rollout(self, interrupt: bool = True, workers: int = 1) -> "Rollout":
        """The task under the master, in the simulator. Runs the text of the procedures' modules."""
        from mindrun.sim.rollouts import rollout_for

        of, task, first = self.ready.policy, self.task.name, self.first or self.master
        return rollout_for(of, task, first, procedures=self.folder, interrupt=interrupt, workers=workers)


def set_up(
    file: str, compiled: Compiled, task: str | None, master: str | None, untaught: bool = False, robot: int = 0
) -> RunSetup:
    """The task and the master of these names, or the default ones; SetupError where they cannot run.

    Where skills may be `untaught`, those that are have weights of 0. Of several robots that of the number is watched.
    """
    _, graph = compiled.whole
    chosen, note = task_of(graph, task)
    leader = master_of(graph, chosen, master)
    folder = compiled.sources[0].folder
    if untaught:
        ready = with_zero_weights(make_ready(graph, compiled.sources, leader, chosen))
    else:
        ready = ready_to_act(file, compiled, leader, chosen)
    return RunSetup(chosen, leader, ready, folder, note).watching(robot)


def ready_to_act(file: str, compiled: Compiled, master: str | None = None, task: Task | None = None) -> ReadyMind:
    """The mind under a master, by default its own, or of all who act in a task; SetupError without weights that fit."""
    _, graph = compiled.whole
    ready = make_ready(graph, compiled.sources, master, task)
    if ready.refusals:
        raise SetupError("\n".join(ready.refusals), train_command(Path(file), ready))
    return ready


def with_zero_weights(ready: ReadyMind) -> ReadyMind:
    """The mind with weights of 0 for each skill that has none that fit, which then sends 0 whatever it reads."""
    graph, untaught = ready.policy.graph, untaught_skills(ready)
    if not untaught:
        return ready
    zeros = {skill.name: np.zeros(genes(skill), np.float32) for skill in graph.skills if skill.name in untaught}
    said = f"not taught, and so sending 0 whatever is read: {listed(untaught, 'and')}"
    return ReadyMind(Policy(graph, {**ready.policy.weights, **zeros}), (), (*ready.notes, said))


def train_command(file: Path, ready: ReadyMind) -> str:
    return command_line("mindc", "train", file, *untaught_skills(ready))


def untaught_skills(ready: ReadyMind) -> list[str]:
    """The skills without weights that fit, subskills first."""
    reached = reachable(ready.policy.graph, ready.policy.graph.master)
    return [name for name in reversed(owners(reached)) if name not in ready.policy.weights]


def layouts(seed: int, runs: int) -> list[int]:
    """The seeds of so many runs; MindError where these are none."""
    seed, runs = bounded_int("seed", SEED_BOUNDS, seed), bounded_int("runs", RUN_BOUNDS, runs)
    return [int(word) for word in np.random.SeedSequence(seed).generate_state(runs, np.uint64)]


def run_all(
    scorer: "Rollout | JobScorer", seeds: Sequence[int], ran: Callable[[float], None] = lambda runs: None
) -> Scores:
    """A run of each seed; `ran` is told how many more have been made, parts of them too."""
    if isinstance(scorer, JobScorer):
        return scorer.score(NO_GENOME, seeds, ran)
    whole = empty_scores(1, len(seeds), scorer.task)
    for first in range(0, len(seeds), SLICE_RUNS):
        block = Block(slice(0, 1), slice(first, min(len(seeds), first + SLICE_RUNS)))
        write_scores(block, scorer.score(NO_GENOME, seeds[block.seeds], ran), whole)
    return whole


def run_timed(
    scorer: "Rollout | JobScorer", seeds: Sequence[int], ran: Callable[[float], None] = lambda runs: None
) -> tuple[Scores, float, float]:
    """A run of each seed, the seconds that all of them took, and those of the processors of this machine.

    The first is made twice before where it may not be the same again, which is in the scorer's notes then.
    """
    scorer.make_again(NO_GENOME[0], seeds[0])
    began, cpu_began = perf_counter(), cpu_seconds()
    scores = run_all(scorer, seeds, ran)
    return scores, perf_counter() - began, cpu_seconds() - cpu_began
