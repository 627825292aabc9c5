"""A project under a name: its texts, of a robot and a task put together, and the folder that is made of them."""

import errno
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from shutil import rmtree
from string import Template

from mindrun.errors import MindError
from mindrun.files.atomic_write import sync_folder

from mindlang.templates import TEMPLATES, Robot, RobotPart, Task

DRIVES = "  drives $drives\n"
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
MAX_NAME_CHARACTERS = 40


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
    parts = [robot, *_needed(robot.act, task), *_needed(robot.sense, task)]
    return f"{task.head}{settings}\n{_joined(part.mind for part in parts)}\n{task.mind.replace(DRIVES, drives)}"


def _wiring(robot: Robot, task: Task) -> str:
    """The text of robot.yaml: the wiring of all that the task needs, and of what moves the robot."""
    sensors = _joined(part.wiring for part in _needed(robot.sense, task))
    actuators = _joined(part.wiring for part in (robot, *_needed(robot.act, task)))
    return _with_parts(sensors, actuators)


def wiring_file(name: str, sensors: str, actuators: str) -> str:
    """The text of the robot.yaml of NAME.mind, with these lines below sensors and actuators."""
    return Template(_with_parts(sensors, actuators)).safe_substitute(name=name)


def _with_parts(sensors: str, actuators: str) -> str:
    return _text("robot.yaml").replace("$sensors\n", sensors).replace("$actuators\n", actuators)


def _needed(parts: Mapping[str, RobotPart], task: Task) -> list[RobotPart]:
    return [part for need, part in parts.items() if need in task.needs]


def _joined(texts: Iterable[str]) -> str:
    return "\n".join(filter(None, texts))


def _text(name: str) -> str:
    return (TEMPLATES / "files" / f"{name}.in").read_text(encoding="utf-8")


def check_name(name: str) -> None:
    """MindError where files, tests and robots cannot have this name."""
    if len(name) > MAX_NAME_CHARACTERS:
        raise MindError(f"A name has at most {MAX_NAME_CHARACTERS} characters, this one {len(name)}.")
    if NAME.fullmatch(name) is None:
        usable = re.sub(r"[^A-Za-z0-9_]+", "_", name.strip()).strip("_").lstrip("0123456789_")
        raise MindError(
            f"A project cannot be called {name!r}: a name is letters, digits and _, and begins with a letter.",
            f"Write {usable} instead." if usable else "Write rover, for example.",
        )


def check_free(folder: Path) -> None:
    """MindError where something is in the way: anything but an empty folder."""
    try:
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise MindError(f"{folder} is there, and is no folder.", "Take another name.")
        if folder.is_dir() and any(folder.iterdir()):
            raise MindError(f"{folder} is there, and not empty: nothing is overwritten.", "Take another name.")
    except OSError as error:
        raise MindError(f"{folder} cannot be made: {error.strerror}.") from error


def make_folder(folder: Path, files: Mapping[str, str]) -> None:
    """Write files into a new folder, all of them or none; MindError where it cannot be made, or is not empty."""
    beside = folder.with_name(f".{folder.name}-{os.getpid()}.mind-tmp")
    try:
        beside.mkdir()
        for name, text in files.items():
            with (beside / name).open("x", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
        beside.rename(folder)  # takes the place of an empty folder, and of nothing else
        sync_folder(folder.parent)
    except OSError as error:
        if error.errno in {errno.ENOTEMPTY, errno.EEXIST, errno.ENOTDIR}:
            check_free(folder)
        raise MindError(f"{folder} cannot be made: {error.strerror}.") from error
    finally:
        rmtree(beside, ignore_errors=True)
