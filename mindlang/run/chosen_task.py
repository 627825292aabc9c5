"""The task of a run and the master in charge, by their names or by default."""

from collections.abc import Sequence
from typing import Never

from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.graph.tasks import default_task, robots_in

from mindlang.compiler.diagnostic import did_you_mean, listed


class SetupError(MindError):
    """A run that cannot begin. `misuse`: the command line is what is wrong."""

    def __init__(self, message: str, hint: str = "", misuse: bool = False) -> None:
        super().__init__(message, hint)
        self.misuse = misuse


def task_of(graph: Graph, name: str | None) -> tuple[Task, str]:
    """The task of that name; without one, the mind's default, and why it is that one where this needs saying."""
    if not graph.tasks:
        raise SetupError("there is no task to run", "add one: task Go in plain")
    if name is None:
        return default_task(graph)
    found = next((task for task in graph.tasks if task.name == name), None)
    return found or unknown("task", name, [task.name for task in graph.tasks]), ""


def master_of(graph: Graph, task: Task | None, name: str | None) -> str:
    """The master in charge of a task: the skill of that name; without one, the master of the task's first lesson.

    The mind's own master where a lesson on the task is under it, or none is on the task, or there is no task.
    """
    if name is not None:
        return skill_of(graph, name)
    masters = [lesson.master for lesson in graph.lessons if task and lesson.task == task.name]
    return masters[0] if masters and graph.master not in masters else graph.master


def robot_of(task: Task, number: int) -> int:
    """The number itself, if a robot in the task's world has it; else SetupError."""
    last = robots_in(task) - 1
    if number <= last:
        return number
    hint = f"its robots are 0 to {last}" if last else "its only robot is robot 0"
    raise SetupError(f"there is no robot {number} in {task.name}", hint, misuse=True)


def skill_of(graph: Graph, name: str) -> str:
    """The name itself, if a skill has it; else SetupError."""
    skills = [skill.name for skill in graph.skills]
    return name if name in skills else unknown("skill", name, skills)


def unknown(noun: str, name: str, known: Sequence[str]) -> Never:
    """SetupError for a name that is none, with one that was nearly written or those that there are."""
    hint = did_you_mean(name, known) or f"There is {listed(known, 'and')}."
    raise SetupError(f"there is no {noun} called {name}", hint, misuse=True)
