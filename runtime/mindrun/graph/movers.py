"""The skills that move the robot: those that drive an actuator by which its body is moved."""

from collections.abc import Container

from mindrun.graph.graph import Graph
from mindrun.graph.skill_sets import reachable


def movers(graph: Graph, master: str) -> dict[str, int]:
    """The skills below a master that drive something that moves the robot, by name, with their places in the graph."""
    return driving(graph, master, {i for i, actuator in enumerate(graph.actuators) if actuator.kind.moves_body})


def driving(graph: Graph, master: str, actuators: Container[int]) -> dict[str, int]:
    """The skills below a master that drive one of these actuators."""
    numbers = graph.skill_numbers
    return {
        skill.name: numbers[skill.name]
        for skill in reachable(graph, master)
        if any(edge.to == "actuator" and edge.target in actuators for edge in skill.edges)
    }
