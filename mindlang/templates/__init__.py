"""Robots and tasks of which `mindc new` makes a project, each a file of data in `robots/` or `tasks/`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TypeVar

from mindrun.errors import MindError

from mindlang.compiler.diagnostic import did_you_mean, listed

TEMPLATES = Path(__file__).parent
FIRST_ROBOT, FIRST_TASK = "differential", "patrol"  # what is made where nothing is said


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotPart:
    """Something of a robot: its lines in the mind, and those that wire it in robot.yaml."""

    mind: str
    wiring: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot(RobotPart):
    """A robot: what moves it, and by which names a task may ask for what else it has.

    `drives` names the actuators that a skill of any task drives; `sense` and `act` are parts a task may need.
    """

    name: str
    about: str
    drives: tuple[str, ...]
    sense: Mapping[str, RobotPart]
    act: Mapping[str, RobotPart] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """A task: what it needs of a robot, and the lines of the mind that are its own.

    `names` are what a robot's parts call the things of this task; `tick` is how long one is. `head` begins the file,
    `mind` follows the robot, `test` ends test_NAME.py; `shows` completes "It …" in the README. `picture_seed` is of a
    run worth looking at.
    """

    name: str
    about: str
    needs: tuple[str, ...]
    names: Mapping[str, str]
    master: str
    shows: str
    head: str
    mind: str
    test: str
    tick: str = "1/20 s"
    picture_seed: int = 1


Kind = TypeVar("Kind", Robot, Task)


@cache
def robots() -> Mapping[str, Robot]:
    """Every robot by its name, the first choice first."""
    return _templates("robots", FIRST_ROBOT, Robot)


@cache
def tasks() -> Mapping[str, Task]:
    """Every task by its name, the first choice first."""
    return _templates("tasks", FIRST_TASK, Task)


def _templates(folder: str, first: str, of: type[Kind]) -> dict[str, Kind]:
    import tomllib

    import msgspec

    paths = sorted((TEMPLATES / folder).glob("*.toml"), key=lambda path: (path.stem != first, path.stem))
    texts = {path.stem: path.read_text(encoding="utf-8") for path in paths}
    return {name: msgspec.convert(tomllib.loads(text) | {"name": name}, of) for name, text in texts.items()}


def missing(robot: Robot, task: Task) -> list[str]:
    """The parts that a task needs and a robot has not."""
    return [need for need in task.needs if need not in robot.sense and need not in robot.act]


def tasks_of(robot: Robot) -> list[str]:
    """The tasks that a robot can do."""
    return [task.name for task in tasks().values() if not missing(robot, task)]


def robots_for(task: Task) -> list[str]:
    """The robots that can do a task."""
    return [robot.name for robot in robots().values() if not missing(robot, task)]


def known(noun: str, name: str, among: Mapping[str, Kind]) -> Kind:
    """The robot or the task of that name; MindError where there is none."""
    if name not in among:
        hint = did_you_mean(name, among) or f"There are {listed(among, 'and')}."
        raise MindError(f"There is no {noun} called {name}.", hint)
    return among[name]


def fitting(robot: Robot | None, task: Task | None) -> tuple[Robot, Task]:
    """Both, where what is not said is the first that goes together with the other; MindError where they do not."""
    robot = robot or robots()[robots_for(task)[0] if task else FIRST_ROBOT]
    task = task or tasks()[tasks_of(robot)[0]]
    if lacks := missing(robot, task):
        raise MindError(
            f"{task.name} needs {listed(lacks, 'and')}, which the robot {robot.name} has not.",
            f"{task.name} goes with --robot {listed(robots_for(task))}, "
            f"{robot.name} with --task {listed(tasks_of(robot))}.",
        )
    return robot, task
