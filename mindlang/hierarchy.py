"""The hierarchy of influence: parents before children, and the cycle that makes this impossible."""

from collections.abc import Iterable
from heapq import heapify, heappop, heappush
from typing import Any

from mindlang.diagnostic import Findings, Label
from mindlang.model import Skill


def digraph(skills: Iterable[Skill]) -> Any:
    """The influences as a networkx graph; an edge carries its `edge`, a skill its `skill`."""
    import networkx as nx  # slow to import, and a mind without cycles does without it

    graph = nx.DiGraph()
    for skill in skills:
        graph.add_node(skill.name, skill=skill)
    for skill in list(skills):
        graph.add_edges_from((skill.name, edge.target, {"edge": edge}) for edge in skill.edges if edge.to == "skill")
    return graph


def in_order(skills: tuple[Skill, ...]) -> tuple[Skill, ...]:
    """The skills with parents first, otherwise in their order; those on or below a cycle are missing."""
    place = {skill.name: index for index, skill in enumerate(skills)}
    parents = dict.fromkeys(place, 0)
    for skill in skills:
        for child in skill.subskills:
            parents[child] += 1
    ready = [place[name] for name, count in parents.items() if count == 0]
    heapify(ready)
    order = []
    while ready:
        skill = skills[heappop(ready)]
        order.append(skill)
        for child in skill.subskills:
            parents[child] -= 1
            if parents[child] == 0:
                heappush(ready, place[child])
    return tuple(order)


def check_cycles(skills: tuple[Skill, ...], findings: Findings) -> None:
    """Report a cycle of influence with its whole path."""
    if len(in_order(skills)) == len(skills):
        return
    import networkx as nx

    graph = digraph(skills)
    steps = nx.find_cycle(graph)
    path = " → ".join([steps[0][0], *(target for _, target in steps)])
    spans = [graph.edges[step]["edge"].fact.span for step in steps]
    labels = (Label(span, "and from there on") for span in spans[1:])
    hint = "Influence flows one way, from the master down: take one of these lines out."
    findings.error("influence-cycle", spans[0], f"Skills influence one another in a circle: {path}.", hint, *labels)
