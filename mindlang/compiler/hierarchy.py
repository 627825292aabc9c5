"""Algorithms on the graphs of a mind: topological order, reachable nodes, and cycles, each with its path."""

from collections.abc import Iterable
from itertools import chain, islice, pairwise
from typing import Any

import networkx as nx
from networkx import DiGraph

from mindlang.compiler.diagnostic import Findings, Label

MAX_CIRCLES = 20  # that are reported at once: a tangle can have more than anybody waits for


def topological_order(graph: DiGraph) -> list[Any]:
    """The nodes in topological order, parents first and otherwise as they were added; there are no circles."""
    place = {node: index for index, node in enumerate(graph)}
    return list(nx.lexicographical_topological_sort(graph, key=place.__getitem__))


def with_descendants(graph: DiGraph, nodes: Iterable[Any]) -> set[Any]:
    """These nodes, and all that is reached from them."""
    return set(chain.from_iterable(nx.bfs_layers(graph, list(nodes))))


def with_ancestors(graph: DiGraph, nodes: Iterable[Any]) -> set[Any]:
    """These nodes, and all from which they are reached."""
    return with_descendants(graph.reverse(copy=False), nodes)


def circles(graph: DiGraph) -> list[list[Any]]:
    """The circles of a graph, at most MAX_CIRCLES, each from its node that was added first, sorted by their nodes."""
    if nx.is_directed_acyclic_graph(graph):
        return []
    nodes, numbered = list(graph), nx.convert_node_labels_to_integers(graph)  # a set of names has no order
    starts = ((circle, circle.index(min(circle))) for circle in islice(nx.simple_cycles(numbered), MAX_CIRCLES))
    found = sorted(circle[start:] + circle[:start] for circle, start in starts)
    return [[nodes[number] for number in circle] for circle in found]


def reverse_topological_order(graph: DiGraph) -> list[Any]:
    """The nodes from which no circle is reached, each after all nodes that are reached from it."""
    circular = [node for part in nx.strongly_connected_components(graph) if len(part) > 1 for node in part]
    ending = graph.copy()
    ending.remove_nodes_from(with_ancestors(graph, [*circular, *nx.nodes_with_selfloops(graph)]))
    return topological_order(ending)[::-1]


def refuse_circles(code: str, graph: DiGraph, findings: Findings, says: str, hint: str, label: str) -> None:
    """Report every circle of a graph with its whole path, along the spans of its edges."""
    for circle in circles(graph):
        around = [*circle, circle[0]]
        first, *others = (graph.edges[step]["span"] for step in pairwise(around))
        findings.error(code, first, f"{says}: {' → '.join(around)}.", hint, *(Label(span, label) for span in others))
