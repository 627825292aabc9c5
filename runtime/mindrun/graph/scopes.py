"""Scopes of influence: for which actuators and memories each line counts, where some are `over` a few of them alone.

What is sent to an actuator is what a hierarchy without the lines would send that are over others (Eq. 2 and 3).
"""

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import NamedTuple

from mindrun.graph.graph import Edge, Graph, Sink

Over = tuple[Sink, ...]


class Scopes(NamedTuple):
    """Scopes, and the scope `of` each sink. Of scope number n the lines do not count that are over `without[n]`.

    Number 0 is without none: there the influence of a skill is all that it was sent, which runs record.
    """

    without: tuple[frozenset[Over], ...]
    of: Mapping[Sink, int]

    def counting(self, edge: Edge) -> tuple[int, ...]:
        """The scopes in which the influence over an edge counts."""
        return tuple(number for number, without in enumerate(self.without) if edge.over not in without)


def influence_scopes(graph: Graph) -> Scopes:
    """The scopes of a graph; one alone where every line counts for all."""
    overs = {edge.over for skill in graph.skills for edge in skill.edges if edge.over}
    sinks: list[Sink] = [("actuator", index) for index in range(len(graph.actuators))]
    sinks += [("memory", index) for index in range(len(graph.memories))]
    lacking = {sink: frozenset(over for over in overs if sink not in over) for sink in sinks}
    without = tuple(dict.fromkeys([frozenset[Over](), *lacking.values()]))
    return Scopes(without, {sink: without.index(lacks) for sink, lacks in lacking.items()})


def within_scope(graph: Graph, scopes: Scopes, number: int) -> Graph:
    """The graph as the sinks of a scope have it: lines that do not count cut whatever arrives (`cuts` is infinite)."""
    without = scopes.without[number]
    if not without:
        return graph

    def counted(edge: Edge) -> Edge:
        return replace(edge, cuts=inf) if edge.over in without else edge

    skills = (replace(skill, edges=tuple(map(counted, skill.edges))) for skill in graph.skills)
    return replace(graph, skills=tuple(skills))
