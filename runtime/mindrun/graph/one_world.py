"""Whether anything of a task is drawn: where nothing is, all of its runs are one."""

from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import measured_in_world
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.things.thing import MOVES

ROUGH = ("noise", "lost", "slip")  # arguments of sensors and actuators of which something is drawn in every tick


def is_one_world(graph: Graph, task: Task, master: str) -> bool:
    """Whether every run of a task under a master is the same, as far as anybody can know.

    Nobody knows what an environment of somebody else's draws, or a procedure.
    """
    if task.scene.environment or task.start.facing is None or any(failure.rate > 0 for failure in task.fails):
        return False
    if task.scene.is_bounded and task.start.at is None:
        return False
    if _varies(graph, task, master) or _draws_things(graph, task):
        return False
    return not _draws_in_ticks(graph, task, master)


def _varies(graph: Graph, task: Task, master: str) -> bool:
    """Whether an argument of what is there in a run is drawn between two numbers: not of a sensor nobody measures."""
    measured = {sensor.name for sensor in measured_in_world(graph, master, task)}
    return any(each.low != each.high and (each.noun != "sensor" or each.of in measured) for each in task.varies)


def _draws_things(graph: Graph, task: Task) -> bool:
    """Whether a place or a size is drawn, when a run begins or when something moves."""
    can_deliver = any(thing.kind.takes_items for thing in task.things)
    can_hold = any(actuator.kind.can_hold for actuator in graph.actuators)
    for kind in (thing.kind for thing in task.things):
        is_drawn = kind.begins[0] != kind.begins[1]
        if kind.is_obstacle:
            rows = [*kind.rows(task.scene)]
            if any(row["count"] or (row["columns"] * row["rows"] and (row["jitter"] or is_drawn)) for row in rows):
                return True
            continue
        delivers = can_deliver and (kind.is_loose or can_hold)
        if is_drawn or not kind.places or kind.wanders:
            return True
        if kind.outcomes.get("reached") == MOVES or (delivers and kind.outcomes.get("delivered") == MOVES):
            return True
    return False


def _draws_in_ticks(graph: Graph, task: Task, master: str) -> bool:
    """Whether a tick draws anything: noise of what is measured, or of what acts, or what a procedure does."""
    if any(skill.function.calls for skill in reachable(graph, master)):
        return True
    kinds: list[object] = [sensor.kind for sensor in measured_in_world(graph, master, task)]
    kinds += [actuator.kind for actuator in graph.actuators]
    return any(getattr(kind, argument, 0.0) for kind in kinds for argument in ROUGH)
