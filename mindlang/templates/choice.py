"""Which robot and which task a project gets, where both, one or none is said."""

from mindrun.errors import MindError

from mindlang.compiler.diagnostic import did_you_mean
from mindlang.templates.catalogue import Robot, Task, can, missing, robots, robots_for, tasks, tasks_of


class ChoiceError(MindError):
    """A robot or a task that there is not, or two that do not go together."""


def known_robot(name: str) -> Robot:
    """The robot of that name; ChoiceError where there is none."""
    if name not in robots():
        hint = did_you_mean(name, robots()) or f"There are {_listed([*robots()])}."
        raise ChoiceError(f"There is no robot called {name}.", hint)
    return robots()[name]


def known_task(name: str) -> Task:
    """The task of that name; ChoiceError where there is none."""
    if name not in tasks():
        hint = did_you_mean(name, tasks()) or f"There are {_listed([*tasks()])}."
        raise ChoiceError(f"There is no task called {name}.", hint)
    return tasks()[name]


def fitting(robot: Robot | None, task: Task | None) -> tuple[Robot, Task]:
    """Both, where what is not said is the first that goes together with the other; ChoiceError where they do not."""
    robot = robot or robots()[robots_for(task)[0] if task else next(iter(robots()))]
    task = task or tasks()[tasks_of(robot)[0]]
    if not can(robot, task):
        raise ChoiceError(
            f"{task.name} needs {_listed(missing(robot, task))}, which the robot {robot.name} has not.",
            f"{task.name} goes with --robot {_listed(robots_for(task), 'or')}, "
            f"{robot.name} with --task {_listed(tasks_of(robot), 'or')}.",
        )
    return robot, task


def _listed(names: list[str], word: str = "and") -> str:
    return f" {word} ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
