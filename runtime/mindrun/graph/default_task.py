"""The task on which a mind is run where nobody names one."""

from mindrun.graph.graph import Graph, Task
from mindrun.graph.skill_sets import reachable


def default_task(graph: Graph) -> tuple[Task, str]:
    """The task on which the master is taught, else one of its name on which no skill is, but others are elsewhere.

    Else one on which a skill below it is taught, else the first. And, where a lesson could have said another, a
    sentence why it is this one. The mind has a task.
    """
    tasks = {task.name: task for task in graph.tasks}
    taught = {lesson.master: lesson.task for lesson in reversed(graph.lessons)}  # the first lesson under each
    if graph.master in taught:
        return tasks[taught[graph.master]], ""
    if graph.lessons and graph.master in tasks.keys() - taught.values():
        return tasks[graph.master], _why(graph, f"{graph.master}, which has its name")
    for skill in reachable(graph, graph.master):
        if skill.name in taught:
            task = tasks[taught[skill.name]]
            return task, _why(graph, f"{task.name}, on which {skill.name} is taught")
    return graph.tasks[0], _why(graph, f"{graph.tasks[0].name}, the first")


def _why(graph: Graph, what: str) -> str:
    said = f"no lesson is under {graph.master}, so the task is {what}; --task names another"
    return said if graph.lessons and len(graph.tasks) > 1 else ""
