"""The task on which a mind is run where nobody names one."""

from mindrun.graph import Graph, Task
from mindrun.weights import reachable


def default_task(graph: Graph) -> tuple[Task, str]:
    """The task on which the master is taught, else one on which a skill below it is, else the first.

    And, where a lesson could have said another, a sentence why it is this one. The mind has a task.
    """
    taught = {lesson.master: lesson.task for lesson in reversed(graph.lessons)}  # the first lesson under each
    for skill in reachable(graph, graph.master):
        if skill.name in taught:
            task = next(task for task in graph.tasks if task.name == taught[skill.name])
            own = skill.name == graph.master
            return task, "" if own else _why(graph, f"{task.name}, on which {skill.name} is taught")
    first = graph.tasks[0]
    return first, _why(graph, f"{first.name}, the first") if graph.lessons and len(graph.tasks) > 1 else ""


def _why(graph: Graph, what: str) -> str:
    return f"no lesson is under {graph.master}, so the task is {what}; --task names another"
