"""The robots and tasks that there are, read from their files, and which of them go together."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

TEMPLATES = Path(__file__).parent
ROBOTS, TASKS = TEMPLATES / "robots", TEMPLATES / "tasks"
FIRST_ROBOT, FIRST_TASK = "differential", "patrol"  # what is made where nothing is said


@dataclass(frozen=True, slots=True)
class Part:
    """Something of a robot: its lines in the mind, and those that wire it in robot.yaml."""

    mind: str
    wiring: str


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot: what moves it, and by which names a task may ask for what else it has.

    `drives` names the actuators that a skill of any task drives; `sense` and `act` are parts a task may need.
    """

    name: str
    about: str
    drives: tuple[str, ...]
    body: Part
    sense: Mapping[str, Part]
    act: Mapping[str, Part] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
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


@cache
def robots() -> Mapping[str, Robot]:
    """Every robot by its name, the first choice first."""
    return {name: _robot(name, data) for name, data in _files(ROBOTS, FIRST_ROBOT)}


@cache
def tasks() -> Mapping[str, Task]:
    """Every task by its name, the first choice first."""
    return {name: _task(name, data) for name, data in _files(TASKS, FIRST_TASK)}


def can(robot: Robot, task: Task) -> bool:
    """Whether a robot has all that a task needs."""
    return missing(robot, task) == []


def missing(robot: Robot, task: Task) -> list[str]:
    """What a task needs and a robot has not."""
    return [need for need in task.needs if need not in robot.sense and need not in robot.act]


def tasks_of(robot: Robot) -> list[str]:
    """The tasks that a robot can do."""
    return [task.name for task in tasks().values() if can(robot, task)]


def robots_for(task: Task) -> list[str]:
    """The robots that can do a task."""
    return [robot.name for robot in robots().values() if can(robot, task)]


def _files(folder: Path, first: str) -> list[tuple[str, dict[str, Any]]]:
    paths = sorted(folder.glob("*.toml"), key=lambda path: (path.stem != first, path.stem))
    return [(path.stem, tomllib.loads(path.read_text(encoding="utf-8"))) for path in paths]


def _robot(name: str, data: dict[str, Any]) -> Robot:
    sense = {key: Part(**part) for key, part in data.get("sense", {}).items()}
    act = {key: Part(**part) for key, part in data.get("act", {}).items()}
    return Robot(name, data["about"], tuple(data["drives"]), Part(data["mind"], data["wiring"]), sense, act)


def _task(name: str, data: dict[str, Any]) -> Task:
    return Task(**data | {"name": name, "needs": tuple(data["needs"])})
