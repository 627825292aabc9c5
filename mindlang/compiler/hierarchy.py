"""The hierarchy of influence: parents before children, and the cycle that makes this impossible."""

from collections.abc import Iterable, Mapping
from heapq import heapify, heappop, heappush
from itertools import pairwise
from typing import TypeVar

from mindrun.graph.reachability import reached_from

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.model import Skill

T = TypeVar("T", int, str)


def in_order(skills: tuple[Skill, ...]) -> tuple[Skill, ...]:
    """The skills with parents first, otherwise in their order; those on or below a cycle are missing."""
    place = {skill.name: index for index, skill in enumerate(skills)}
    children = {place[skill.name]: [place[name] for name in skill.subskills] for skill in skills}
    return tuple(skills[index] for index in parents_first(children))


def parents_first(children: Mapping[T, Iterable[T]]) -> list[T]:
    """The keys with parents first, otherwise the smallest first; those on or below a cycle are missing."""
    parents = dict.fromkeys(children, 0)
    for below in children.values():
        for child in below:
            parents[child] += 1
    ready = [key for key, count in parents.items() if count == 0]
    heapify(ready)
    order: list[T] = []
    while ready:
        order.append(heappop(ready))
        for child in children[order[-1]]:
            parents[child] -= 1
            if parents[child] == 0:
                heappush(ready, child)
    return order


def skills_reached(skills: Mapping[str, Skill], master: str) -> set[str]:
    """The names of the skills that a master influences, itself among them; there may be cycles yet."""
    return reached_from([master], lambda name: skills[name].subskills)


def skills_above(skills: Iterable[Skill], names: Iterable[str]) -> set[str]:
    """The names of the skills that influence some of these, straight or through others, and these themselves."""
    parents: dict[str, list[str]] = {}
    for skill in skills:
        for name in skill.subskills:
            parents.setdefault(name, []).append(skill.name)
    return reached_from(names, lambda name: parents.get(name, ()))


def check_cycles(skills: tuple[Skill, ...], findings: Findings) -> None:
    """Report a cycle of influence with its whole path."""
    if len(in_order(skills)) == len(skills):
        return
    round_trip = _circle({skill.name: skill.subskills for skill in skills})
    path = " → ".join(round_trip)
    edges = {(skill.name, edge.target): edge for skill in skills for edge in skill.edges if edge.to == "skill"}
    spans = [edges[step].fact.span for step in pairwise(round_trip)]
    labels = (Label(span, "and from there on") for span in spans[1:])
    hint = "Influence flows one way, from the master down: take one of these lines out."
    findings.error("influence-cycle", spans[0], f"Skills influence one another in a circle: {path}.", hint, *labels)


def _circle(children: Mapping[str, Iterable[str]]) -> list[str]:
    """The first way down that comes back to where it has been: from there to there."""
    done: set[str] = set()
    for top in children:
        path, waiting = {top: None}, [iter(children[top])]
        while path:
            if (child := next(waiting[-1], None)) is None:
                done.add(path.popitem()[0])
                waiting.pop()
            elif child in path:
                way = list(path)
                return [*way[way.index(child) :], child]
            elif child not in done:
                path[child] = None
                waiting.append(iter(children[child]))
    raise ValueError("there is no circle")
