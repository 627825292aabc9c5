"""The things of a task on which no run begins, since a robot that stood there would have reached them by nothing."""

from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import with_sources
from mindrun.kinds.things.thing import STAYS
from mindrun.numbers.expression import leaves


def goals(graph: Graph, task: Task) -> frozenset[str]:
    """The names of what is no longer as it was once it is reached, and of what an end of the task is about.

    An end is about what its event is about, and about what the sensors of its condition are about. What is only counted
    or rewarded is no goal: what measures changes no world.
    """
    gone = {thing.name for thing in task.things if thing.kind.outcomes.get("reached", STAYS) != STAYS}
    events = (task.events[end.event] for end in task.ends if end.event is not None)
    reached = {event.thing for event in events if event.outcome == "reached"}
    read = {row for end in task.ends if end.when is not None for row in leaves(end.when, "reading")}
    return frozenset(gone | reached | {sensor.kind.thing for sensor in with_sources(graph, read)})
