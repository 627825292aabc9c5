"""The hierarchy of a mind as graphs of networkx: who influences whom, and all that is read, sent and computed.

Every question of order, reach, depth and circles is asked of them, by the compiler, by lint and by a notebook alike.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice, pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from mindrun.kinds.registry import names
from networkx import (
    DiGraph,
    bfs_layers,
    convert_node_labels_to_integers,
    is_directed_acyclic_graph,
    lexicographical_topological_sort,
    nodes_with_selfloops,
    simple_cycles,
    strongly_connected_components,
)

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.syntax import Reads

if TYPE_CHECKING:
    from mindrun.graph.graph import Sensor

    from mindlang.compiler.model import Mind, Part, Skill
    from mindlang.compiler.source import Span

MAX_CIRCLES = 20  # that are reported at once: a tangle can have more than anybody waits for


class Node(NamedTuple):
    """A part of a mind in its hierarchy; a sensor, an actuator and a skill may have one name."""

    noun: str
    name: str

    def __str__(self) -> str:
        return f"{self.noun} {self.name}"


def influence_graph(skills: Sequence[Skill]) -> DiGraph:
    """The skills by name in the order of the text, an edge for each line `influences`, with its `span`."""
    graph = DiGraph()
    graph.add_nodes_from(skill.name for skill in skills)
    for skill in skills:
        graph.add_edges_from((skill.name, e.target, {"span": e.fact.span}) for e in skill.edges if e.to == "skill")
    return graph


def source_graph(sensors: Sequence[Part[Any] | Sensor]) -> DiGraph:
    """The sensors by name in the order of the text, an edge to each sensor or memory that one is computed from."""
    graph = DiGraph()
    graph.add_nodes_from(sensor.name for sensor in sensors)
    for sensor in sensors:
        graph.add_edges_from((sensor.name, source) for source in sensor.kind.sources)
    return graph


def hierarchy(mind: Mind) -> DiGraph:
    """All parts of a mind, and what flows between them from the sensors to the actuators.

    A node has its `kind`, a skill also `like`, `frozen` and whether it is the `master`; an edge has its `relation`
    (reads, influences, drives, computes) and the `file` and `line` that say it. Skills alone are a DAG; a memory that
    is read and driven closes a circle, over one tick.
    """
    graph = DiGraph()
    for noun, parts in (("sensor", mind.sensors), ("memory", mind.memories), ("actuator", mind.actuators)):
        graph.add_nodes_from((Node(noun, part.name), {"kind": names()[type(part.kind)]}) for part in parts)
    for skill in mind.skills:
        about = {"kind": names()[type(skill.function)], "like": skill.like, "frozen": skill.frozen}
        graph.add_node(Node("skill", skill.name), **about, master=skill.name == mind.master)
    read = {part.name: Node(noun, part.name) for noun, part in _readable(mind)}
    for sensor in mind.sensors:
        for source in dict.fromkeys(sensor.kind.sources):
            graph.add_edge(read[source], read[sensor.name], relation="computes", **_place(sensor.span))
    skills = {skill.name: skill for skill in mind.skills}
    for skill in mind.skills:
        here = Node("skill", skill.name)
        lines = {fact.name.text: fact.span for each in (skills[skill.owner], skill) for fact in _reads(each)}
        graph.add_edges_from((read[name], here, {"relation": "reads", **_place(lines[name])}) for name in skill.reads)
        for edge in skill.edges:
            relation = "influences" if edge.to == "skill" else "drives"
            graph.add_edge(here, Node(edge.to, edge.target), relation=relation, **_place(edge.fact.span))
    return graph


def _readable(mind: Mind) -> Iterator[tuple[str, Part[Any]]]:
    yield from (("sensor", sensor) for sensor in mind.sensors)
    yield from (("memory", memory) for memory in mind.memories)


def _reads(skill: Skill) -> Iterator[Reads]:
    return (fact for fact in skill.declaration.facts if isinstance(fact, Reads))


def _place(span: Span) -> dict[str, str | int]:
    return {"file": span.source.name, "line": span.line}


def in_order(graph: DiGraph) -> list[Any]:
    """The nodes in topological order, parents first and otherwise as they were added; there are no circles."""
    place = {node: index for index, node in enumerate(graph)}
    return list(lexicographical_topological_sort(graph, key=place.__getitem__))


def below(graph: DiGraph, nodes: Iterable[Any]) -> set[Any]:
    """These nodes, and all that is reached from them."""
    return set(chain.from_iterable(bfs_layers(graph, list(nodes))))


def above(graph: DiGraph, nodes: Iterable[Any]) -> set[Any]:
    """These nodes, and all from which they are reached."""
    return below(graph.reverse(copy=False), nodes)


def circles(graph: DiGraph) -> list[list[Any]]:
    """The circles of a graph, each from that of its nodes on that was added first, in their order.

    Of more than MAX_CIRCLES so many.
    """
    if is_directed_acyclic_graph(graph):
        return []
    nodes, numbered = list(graph), convert_node_labels_to_integers(graph)  # a set of names has no order
    found = (_turned(circle) for circle in islice(simple_cycles(numbered), MAX_CIRCLES))
    return [[nodes[number] for number in circle] for circle in sorted(found)]


def ends_first(graph: DiGraph) -> list[Any]:
    """The nodes that lead into no circle, each after all that it leads to."""
    circular = [node for part in strongly_connected_components(graph) if len(part) > 1 for node in part]
    ending = graph.copy()
    ending.remove_nodes_from(above(graph, [*circular, *nodes_with_selfloops(graph)]))
    return in_order(ending)[::-1]


def _turned(circle: list[int]) -> list[int]:
    first = circle.index(min(circle))
    return circle[first:] + circle[:first]


def check_cycles(graph: DiGraph, findings: Findings) -> None:
    """Report every circle of influence with its whole path."""
    for circle in circles(graph):
        around = [*circle, circle[0]]
        first, *others = (graph.edges[step]["span"] for step in pairwise(around))
        labels = (Label(span, "and from there on") for span in others)
        message = f"Skills influence one another in a circle: {' → '.join(around)}."
        hint = "Influence flows one way, from the master down: take one of these lines out."
        findings.error("influence-cycle", first, message, hint, *labels)
