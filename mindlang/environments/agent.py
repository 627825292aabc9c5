"""Who acts in an environment: a program that commands every actuator, or one that plays a skill of the hierarchy."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Skill, Task
from mindrun.graph.policy import Policy
from mindrun.graph.weights import reachable
from mindrun.sim.commanded_lanes import CommandedLanes, commanded_lanes
from mindrun.sim.rollout import Rollout
from mindrun.terminal.command_line import command_line
from numpy.typing import NDArray

from mindlang.api import Mind, load
from mindlang.lock.ready import ReadyMind, make_ready
from mindlang.run.chosen_task import master_of, task_of, unknown
from mindlang.run.setup import RunSetup, untaught_skills


@dataclass(frozen=True, slots=True)
class Agent:
    """It sees the readings with these numbers, and acts by so many numbers in 0..1.

    `played` is the skill that it plays, and `row` that one's in the tables; None where it commands the actuators.
    """

    setup: RunSetup
    lanes: CommandedLanes
    readings: NDArray[np.int64]
    actions: int
    row: int | None = None
    played: str | None = None

    def act(self, actions: NDArray[np.float32]) -> None:
        """One tick under its actions [lanes, actions]; one that is not finite is not sent."""
        if self.row is None:
            self.lanes.command(actions)
        else:
            self.lanes.play(self.row, actions)
        self.lanes.act()


def agent_of(file: Path, task: str | None, master: str | None, skill: str | None, lanes: int) -> Agent:
    """The agent in so many lanes; MindError where the mind, the task or a skill cannot be so."""
    mind = load(file)
    if skill is not None:
        return _of_skill(mind, task, master, skill, lanes)
    chosen, _ = task_of(mind.graph, task)
    leader = master_of(mind.graph, chosen, master)
    ready = ReadyMind(Policy(mind.graph, {}), (), ())  # no skill runs, so none needs its weights
    several = commanded_lanes(mind.graph, chosen.name, leader, lanes)
    seen = {row for each in reachable(mind.graph, leader) for row in each.inputs}
    sensed = sum(sensor.width for sensor in mind.graph.sensors)  # behind these are the memories of skills
    rows = np.array(sorted(row for row in seen if row < sensed), np.int64)
    return Agent(_setup(mind, chosen, leader, ready), several, rows, len(mind.graph.actuators))


def _of_skill(mind: Mind, task: str | None, master: str | None, skill: str, lanes: int) -> Agent:
    graph = mind.graph
    if skill not in (names := [each.name for each in graph.skills]):
        unknown("skill", skill, names)
    lesson = next((each for each in graph.lessons if each.skill == skill), None)
    chosen, _ = task_of(graph, task or (lesson.task if lesson else None))
    is_its_lesson = lesson is not None and lesson.task == chosen.name
    leader = master_of(graph, chosen, master or (lesson.master if lesson and is_its_lesson else None))
    played = _played(graph, leader, skill)
    ready = make_ready(graph, mind.compiled.sources, leader)
    if missing := [name for name in untaught_skills(ready) if name != played.owner]:
        raise MindError(ready.refusals[-1], command_line("mindc", "train", mind.path, *missing))
    folder = mind.path.absolute().parent
    rollout = Rollout(ready.policy, chosen.name, leader, [skill], procedures=folder)
    number = ready.policy.graph.skill_numbers[skill]
    row = int(np.flatnonzero(rollout.tables.skills["index"] == number)[0])
    inputs = np.array(ready.policy.graph.skills[number].inputs, np.int64)
    several = CommandedLanes(rollout, lanes)
    return Agent(_setup(mind, chosen, leader, ready), several, inputs, played.outputs, row, skill)


def _played(graph: Graph, master: str, name: str) -> Skill:
    """The skill of that name; MindError where nobody can play it."""
    reached = reachable(graph, master)
    skill = next((each for each in reached if each.name == name), None)
    if skill is None:
        raise MindError(f"{name} is not below {master}", f"name a master that influences it: master={name!r}")
    if not skill.outputs:
        raise MindError(f"{name} has no outputs: all that it sends is said by `at`", "play another skill")
    if like := [each.name for each in reached if each.owner == skill.owner and each.name != name]:
        raise MindError(f"{name} shares its weights with {like[0]}", "a master above one of them can be played")
    return skill


def _setup(mind: Mind, task: Task, master: str, ready: ReadyMind) -> RunSetup:
    return RunSetup(task, master, ready, mind.path.absolute().parent)
