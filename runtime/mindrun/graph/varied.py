"""Which part of a graph, or which thing of a task, an argument that varies is of."""

from typing import Any

from mindrun.graph.graph import Graph, Task
from mindrun.kinds.variation import Variation


def varied_kind(graph: Graph, task: Task, variation: Variation) -> Any:
    """The kind whose argument varies; None where there is none of that name."""
    if variation.noun == "body":
        return None if variation.of else graph.body
    parts: Any = {"actuator": graph.actuators, "sensor": graph.sensors, "thing": task.things}[variation.noun]
    return next((part.kind for part in parts if part.name == variation.of), None)
