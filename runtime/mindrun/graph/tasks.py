"""Tasks before a run: which one is run, its goals, whether anything is drawn, and the physics of its world."""

from collections.abc import Collection, Sequence
from importlib.metadata import PackageNotFoundError, version
from itertools import chain
from typing import Any

from mindrun.graph.graph import Graph, Task, Thing, Variation
from mindrun.graph.measured import measured_in_world, with_sources
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.things.thing import MOVES, STAYS
from mindrun.numbers.expression import leaves

HALF_DIAGONAL = 0.7072  # of a square with side 1, and a little more
ROUGH = ("noise", "lost", "slip")  # arguments of sensors and actuators of which something is drawn in every tick
# One more with each change after which a run of the same seed can be another: how bodies move, what is solid, how a
# world begins, what sensors measure. Weights that were taught before are then said to be taught elsewhere.
WORLD_VERSION = 1


def physics() -> dict[str, str | int]:
    """The versions of pymunk, "" where it is not installed, and of the world that is our own."""
    return {"pymunk": installed_version("pymunk"), "world": WORLD_VERSION}


def installed_version(package: str) -> str:
    """The version of a package; "" where it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def masters_in(task: Task, master: str) -> list[str]:
    """The skill in charge of each robot in the world of a task, where `master` is of the first."""
    others = (thing for thing in task.things if thing.kind.is_robot)
    return [master, *(thing.master or master for thing in others for _ in range(thing.kind.copies))]


def robots_in(task: Task) -> int:
    """The number of robots in the world of a task: the first, and those that it contains."""
    return len(masters_in(task, ""))


def default_task(graph: Graph) -> tuple[Task, str]:
    """The task to run where none is named, and a sentence why it is this one; "" where that goes without saying."""
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


def own_name(task: Task) -> str:
    """The name that the first robot has for others: that of the first under its master; empty where it has none."""
    return next((thing.name for thing in task.things if thing.kind.is_robot and not thing.master), "")


def things_of(task: Task) -> list[Thing]:
    """The things of a task but its obstacles, each as many times as there are copies of it: the rows of the lanes.

    The first robot is one more of those that have its name, before them.
    """
    own = own_name(task)
    apart = (thing for thing in task.things if not thing.kind.is_obstacle)
    return [thing for thing in apart for _ in range(thing.kind.copies + (thing.kind.is_robot and thing.name == own))]


def goals(graph: Graph, task: Task) -> frozenset[str]:
    """The names of things that change once they are reached, and of those that an end of the task is about.

    An end is about what its event is about, and about what the sensors of its condition are about. What is only counted
    or rewarded is no goal: what measures changes no world.
    """
    gone = {thing.name for thing in task.things if thing.kind.outcomes.get("reached", STAYS) != STAYS}
    events = (event for end in task.ends if end.event is not None for event in task.events[end.event].single)
    reached = {event.thing for event in events if event.outcome == "reached"}
    read = {row for end in task.ends if end.when is not None for row in leaves(end.when, "reading")}
    return frozenset(gone | reached | {thing for sensor in with_sources(graph, read) for thing in sensor.kind.things})


def unfit_thing(things: Sequence[Any], names: Collection[str]) -> Any:
    """The thing for which a sensor cannot be about all of these names in a world of `things`; None where it can."""
    if len(names) == 1:
        return None
    loose = [thing for thing in things if not (thing.kind and thing.kind.is_obstacle)]
    places = [place for place, thing in enumerate(loose) if thing.name in names]
    between = loose[places[0] : places[-1]] if places else []
    fixed = (thing for thing in things if thing not in loose and thing.name in names)
    return next(chain(fixed, (thing for thing in between if thing.name not in names)), None)


def varied_kind(graph: Graph, task: Task, variation: Variation) -> Any:
    """The kind whose argument varies; None where there is none of that name."""
    if variation.noun == "body":
        return None if variation.of else graph.body
    parts: Any = {"actuator": graph.actuators, "sensor": graph.sensors, "thing": task.things}[variation.noun]
    return next((part.kind for part in parts if part.name == variation.of), None)


def is_one_world(graph: Graph, task: Task, master: str) -> bool:
    """True if every run of a task under a master is the same, as far as anybody can know."""
    if task.scene.environment or task.start.facing is None or any(failure.rate > 0 for failure in task.fails):
        return False
    if task.scene.is_bounded and task.start.at is None:
        return False
    measured = {sensor.name for sensor in measured_in_world(graph, master, task)}
    if any(each.low != each.high and (each.noun != "sensor" or each.of in measured) for each in task.varies):
        return False
    if _draws_things(graph, task) or _draws_numbers(task):
        return False
    return not _draws_in_ticks(graph, task, master)


def _draws_things(graph: Graph, task: Task) -> bool:
    """True if a place or a size is drawn, when a run begins or when something moves."""
    can_deliver = any(thing.kind.takes_items for thing in task.things)
    can_hold = any(actuator.kind.can_hold for actuator in graph.actuators)
    for kind in (thing.kind for thing in task.things):
        is_drawn = kind.begins[0] != kind.begins[1]
        if kind.is_obstacle:
            rows = [*kind.rows(task.scene)]
            if kind.options or any(
                row["count"] or (row["columns"] * row["rows"] and (row["jitter"] or is_drawn)) for row in rows
            ):
                return True
            continue
        delivers = can_deliver and (kind.is_loose or can_hold)
        if is_drawn or not kind.places or kind.wanders:
            return True
        if kind.outcomes.get("reached") == MOVES or (delivers and kind.outcomes.get("delivered") == MOVES):
            return True
    return False


def _draws_numbers(task: Task) -> bool:
    """True if a number is drawn that a thing, a reward or an end depends on."""
    read = {index for program in task.programs for index in leaves(program, "drawn")}
    read |= {index for thing in task.things for program in thing.programs for index in leaves(program, "drawn")}
    read |= {thing.many - 1 for thing in task.things if thing.many}
    return any(len({*task.draws[index].values}) > 1 for index in read)


def _draws_in_ticks(graph: Graph, task: Task, master: str) -> bool:
    """True if a tick draws anything: noise of sensors or actuators, or something in a procedure, as far as is known."""
    if any(skill.function.calls for skill in reachable(graph, master)):
        return True
    measured = [sensor.kind for sensor in measured_in_world(graph, master, task)]
    if any(kind.is_order for kind in measured):
        return True
    kinds: list[object] = [*measured]
    kinds += [actuator.kind for actuator in graph.actuators]
    return any(getattr(kind, argument, 0.0) for kind in kinds for argument in ROUGH)


def meets_robot(
    is_area: bool, is_round: bool, is_goal: bool, size: float, dx: float, dy: float, radius: float, reach: float
) -> bool:
    """True if a thing (dx, dy) from the robot's middle overlaps the robot, or is a goal that it has reached already.

    On what lies on the floor, an area, the robot may begin, unless that is a goal. `radius` is that of the circle
    around the robot, `reach` how far from its middle the claw's place reaches, whichever way it faces.
    """
    if is_area:
        return is_goal and max(abs(dx), abs(dy)) <= size / 2
    gap = radius + (size / 2 if is_round else size * HALF_DIAGONAL)
    if is_goal:
        gap = max(gap, reach + size / 2)
    return dx * dx + dy * dy < gap * gap
