"""A project as texts: a robot and a task put together under a name."""

from collections.abc import Iterable, Mapping
from string import Template

from mindlang.templates.catalogue import TEMPLATES, Part, Robot, Task

FILES = TEMPLATES / "files"
DRIVES = "  drives $drives\n"


def project(name: str, robot: Robot, task: Task) -> dict[str, str]:
    """The files of a new project by their names; the robot can do the task."""
    words = {
        **task.names,
        "name": name,
        "Name": name[:1].upper() + name[1:],
        "robot": robot.name,
        "task": task.name,
        "about_robot": robot.about,
        "about_task": task.about,
        "shows": task.shows,
        "master": task.master,
        "picture_seed": str(task.picture_seed),
    }
    texts = {
        f"{name}.mind": _mind(robot, task),
        "robot.yaml": _wiring(robot, task),
        f"test_{name}.py": f"{_text('test.py')}\n\n{task.test}",
        "README.md": _text("README.md"),
        ".gitignore": _text("gitignore"),
    }
    return {path: Template(text).substitute(words) for path, text in texts.items()}


def _mind(robot: Robot, task: Task) -> str:
    """The source: what it is, the robot's part of it, and then the task's."""
    settings = f"mind 1\ntick {task.tick}\nunit 8 cm\nmaster {task.master}\n"
    drives = "".join(f"  drives {actuator}\n" for actuator in robot.drives)
    parts = [robot.body, *_needed(robot.act, task), *_needed(robot.sense, task)]
    return f"{task.head}{settings}\n{_joined(part.mind for part in parts)}\n{task.mind.replace(DRIVES, drives)}"


def _wiring(robot: Robot, task: Task) -> str:
    """What is wired: all that the task needs, and what moves the robot."""
    sensors = _joined(part.wiring for part in _needed(robot.sense, task))
    actuators = _joined(part.wiring for part in (robot.body, *_needed(robot.act, task)))
    return _text("robot.yaml").replace("$sensors\n", sensors).replace("$actuators\n", actuators)


def _needed(parts: Mapping[str, Part], task: Task) -> list[Part]:
    return [part for need, part in parts.items() if need in task.needs]


def _joined(texts: Iterable[str]) -> str:
    return "\n".join(text for text in texts if text)


def _text(name: str) -> str:
    return (FILES / f"{name}.in").read_text(encoding="utf-8")
