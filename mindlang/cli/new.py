"""`mindc new`: a project to begin with, a robot and a task put together.

Examples:
  mindc new rover
  mindc new rover --robot differential --task patrol
  mindc new porter --task fetch
  mindc new --list
  mindc new --list --json
"""

import sys
from pathlib import Path
from typing import Any

import click

from mindlang.cli._options import flag, named, one_of
from mindlang.cli._terminal import MISUSE, fail, print_json, refusing
from mindlang.templates import Robot, Task, fitting, known, robots, robots_for, tasks, tasks_of
from mindlang.templates.project import check_free, check_name, make_folder, project

ROBOTS = one_of(lambda: {name: each.about for name, each in robots().items()})
TASKS = one_of(lambda: {name: each.about for name, each in tasks().items()})


@click.command
@click.argument("name", required=False)
@named("--robot", "ROBOT", ROBOTS, "What it is: --robot differential")
@named("--task", "TASK", TASKS, "What it is to learn: --task patrol")
@flag("--list as_list", "Print which robots and tasks there are: --list")
@flag("--json as_json", "Print that as one JSON document: --list --json")
def command(name: str | None, robot: str | None, task: str | None, as_list: bool, as_json: bool) -> None:
    """Make a folder NAME with a robot that learns a task.

    In it are a mind that is checked and ready to be taught, the robot.yaml that wires it, a test, and a README.md that
    says how to go on. On a terminal whatever is not said is asked; elsewhere it is a differential robot on patrol, or
    what goes together with what is said. Nothing is ever overwritten: where NAME is there and not empty it ends with 2.
    """
    if as_list:
        _print_list(as_json)
        return
    if as_json:
        fail("--json goes with --list.", "mindc new --list --json", MISUSE)
    with refusing(MISUSE):
        if name is not None:
            check_name(name)
            check_free(Path(name))
        chosen_robot, chosen_task = _chosen(robot, task)
        if name is None:
            if not _asks():
                fail("The project has no name.", "mindc new rover", MISUSE)
            name = str(click.prompt("What is it called?", default="rover", err=True))
            check_name(name)
        make_folder(Path(name), project(name, chosen_robot, chosen_task))
    click.echo(f"{name}: a {chosen_robot.name} robot, and how it learns to {chosen_task.name}", err=True)
    click.echo(f"  cd {name}", err=True)
    click.echo(f"  mindc train {name}.mind --seed 1     # in about a minute", err=True)
    click.echo(f"  mindc run {name}.mind --seed {chosen_task.picture_seed} --picture {name}.png", err=True)
    click.echo("README.md says how to go on.", err=True)


def _chosen(robot: str | None, task: str | None) -> tuple[Robot, Task]:
    """The robot and the task that are said, asked for, or go together with what is said."""
    the_robot = None if robot is None else known("robot", robot, robots())
    the_task = None if task is None else known("task", task, tasks())
    if _asks() and the_robot is None:
        about = {each: robots()[each].about for each in (robots_for(the_task) if the_task else robots())}
        the_robot = robots()[_asked("Which robot?", about)]
    if _asks() and the_task is None and the_robot is not None:
        the_task = tasks()[_asked("Which task?", {each: tasks()[each].about for each in tasks_of(the_robot)})]
    return fitting(the_robot, the_task)


def _asks() -> bool:
    """True if there is somebody to answer."""
    return sys.stdin.isatty() and sys.stderr.isatty()


def _asked(question: str, choices: dict[str, str]) -> str:
    """One of the names, by its name or its number; the first where nothing is typed."""
    names = list(choices)
    if len(names) == 1:
        return names[0]
    click.echo(question, err=True)
    for number, (name, about) in enumerate(choices.items(), 1):
        click.echo(f"  {number}  {name:<12}  {about}", err=True)
    numbers = [str(number) for number in range(1, len(names) + 1)]
    answer: Any = click.prompt(
        "", type=click.Choice([*numbers, *names]), default="1", show_choices=False, prompt_suffix="> ", err=True
    )
    return names[int(answer) - 1] if answer in numbers else str(answer)


def _print_list(as_json: bool) -> None:
    """Print the robots and tasks that there are, and which go together."""
    if as_json:
        print_json(
            {
                "robots": [{"name": r.name, "about": r.about, "tasks": tasks_of(r)} for r in robots().values()],
                "tasks": [{"name": t.name, "about": t.about, "robots": robots_for(t)} for t in tasks().values()],
            }
        )
        return
    for noun, there in (("robot", robots()), ("task", tasks())):
        click.echo(f"--{noun}")
        for name, each in there.items():
            click.echo(f"  {name:<13} {each.about}")
    click.echo("together")
    for robot in robots().values():
        click.echo(f"  {robot.name:<13} {', '.join(tasks_of(robot))}")
