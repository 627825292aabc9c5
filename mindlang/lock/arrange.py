"""A graph in the order of its weights."""

from dataclasses import replace

from mindrun.graph.graph import Edge, Graph, Skill
from networkx import DiGraph, lexicographical_topological_sort

from mindlang.lock import Lock
from mindlang.lock.signature import signature


def arrange(graph: Graph, lock: Lock) -> Graph:
    """The graph in the order of its weights, so that moving lines about in the source changes no bit.

    Skills stand parents first and otherwise by name; what a trained skill reads and sends stands as in its line.
    """
    graph = _by_name(graph)
    known = {skill.name: skill for skill in graph.skills}
    taught = {skill.name: _as_taught(graph, skill, lock) for skill in graph.skills if not skill.like}
    taught |= {s.name: _as_owner(s, known[s.like], taught[s.like]) for s in graph.skills if s.like}
    return replace(graph, skills=tuple(taught[name] for name in known))


def _as_owner(skill: Skill, before: Skill, after: Skill) -> Skill:
    """A skill that is like another in the order into which that one has been brought."""
    inputs = dict(zip(before.inputs, skill.inputs, strict=True))
    edges = {(edge.to, edge.target): own for edge, own in zip(before.edges, skill.edges, strict=True)}
    return replace(
        skill,
        inputs=tuple(inputs[index] for index in after.inputs),
        edges=tuple(replace(edges[edge.to, edge.target], output=edge.output) for edge in after.edges),
    )


def _as_taught(graph: Graph, skill: Skill, lock: Lock) -> Skill:
    """A skill with what it reads and sends in the order of its line, if it is the same by name."""
    entry = lock.get(skill.name)
    if entry is None or not entry.signature.reads:
        return skill
    own = signature(graph, skill)
    taught = entry.signature
    if sorted(own.reads) != sorted(taught.reads) or sorted(own.sends) != sorted(taught.sends):
        return skill
    places = {s.name: range(s.start, s.start + s.width) for s in graph.sensors}
    places |= {m.name: range(m.start, m.start + 1) for m in graph.memories if m.name not in places}
    inputs = tuple(index for read in taught.reads for index in places[read.partition(":")[0]])
    learned = {graph.named(edge.to, edge.target): edge for edge in skill.edges if edge.output is not None}
    edges = [replace(learned[name], output=number) for number, name in enumerate(taught.sends)]
    return replace(skill, inputs=inputs, edges=(*edges, *(edge for edge in skill.edges if edge.output is None)))


def _by_name(graph: Graph) -> Graph:
    """The graph with its skills parents first, otherwise by name: sums over parents are taken in this order."""
    children = {
        skill.name: [graph.named(edge.to, edge.target) for edge in skill.edges if edge.to == "skill"]
        for skill in graph.skills
    }
    order = list(lexicographical_topological_sort(DiGraph(children)))
    place = {name: index for index, name in enumerate(order)}
    moved = {
        skill.name: replace(skill, edges=tuple(_moved(graph, edge, place) for edge in skill.edges))
        for skill in graph.skills
    }
    return replace(graph, skills=tuple(moved[name] for name in order))


def _moved(graph: Graph, edge: Edge, place: dict[str, int]) -> Edge:
    return replace(edge, target=place[graph.named("skill", edge.target)]) if edge.to == "skill" else edge
