"""Signatures of genomes: taken from a graph, compared with another, and a graph in the order of its weights."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate

from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.graph.named_readings import named_places
from mindrun.kinds.registry import arguments, later_fields, names
from networkx import DiGraph, lexicographical_topological_sort

from mindlang.lock import Entry, Lock, Signature

MAX_WIDTH_DIGITS = 9  # of how many readings a sensor has, where a text from outside says it


def signature(graph: Graph, skill: Skill) -> Signature:
    """The signature of a skill that learns; of its function every argument is said: mlp hidden 2 width 14."""
    at = {rows.start: (name, len(rows)) for name, rows in named_places(graph).items()}
    read = (at[index] for index in skill.inputs if index in at)
    sends = (graph.named(edge.to, edge.target) for edge in skill.edges if edge.output is not None)
    function = skill.function.explicit(len(skill.inputs), skill.outputs)
    values = {each.field: getattr(function, each.field) for each in arguments(type(function))}
    later = later_fields(type(function))  # of which the locks of before say nothing
    said = (f"{key.removesuffix('_')} {value}" for key, value in values.items() if value != later.get(key, ...))
    return Signature(
        " ".join([names()[type(function)], *said]),
        tuple(f"{name}:{many}" if many > 1 else name for name, many in read),
        tuple(sends),
    )


def differences(old: Signature, new: Signature, derived: Collection[str]) -> tuple[str, ...]:
    """The differences that keep weights from fitting, in sentences; order is none.

    The arguments in `derived` are not told where what is read or sent tells it already, from which they follow.
    """
    had, has = ({read.partition(":")[0]: width(read) for read in each.reads} for each in (old, new))
    found = [*_changes("reads", set(had), set(has))]
    for name in sorted(had.keys() & has.keys()):
        if had[name] != has[name]:
            found.append(f"{name} had {had[name]} reading{'s' * (had[name] != 1)}, now {has[name]}")
    found += _changes("sends", set(old.sends), set(new.sends))
    (old_kind, *before), (new_kind, *now) = old.function.split(), new.function.split()
    if old_kind != new_kind:
        return (f"was {old_kind}, now {new_kind}", *found)
    was, is_ = (dict(zip(words[::2], words[1::2], strict=False)) for words in (before, now))
    for key in was | is_:
        if was.get(key) != is_.get(key) and not (key in derived and found):
            found.append(f"{key} was {was.get(key, 'not there')}, now {is_.get(key, 'not there')}")
    return tuple(found)


def _changes(verb: str, old: set[str], new: set[str]) -> Iterator[str]:
    yield from (f"{verb} {name} is new" for name in sorted(new - old))
    yield from (f"{verb} {name} is gone" for name in sorted(old - new))


def reordered(entry: Entry, graph: Graph) -> tuple[str, ...]:
    """The sensors that a skill reads whose readings stand in another order than in the world it was last taught in."""
    kinds = {sensor.name: sensor.kind for sensor in graph.sensors}
    facts = entry.worlds[-1].facts
    found = []
    for name in (text.partition(":")[0] for text in entry.signature.reads):
        old = facts.get(f"sensor {name}", {}).get("at")
        now = kinds[name].directions if isinstance(old, list) and name in kinds else None
        if now is not None and tuple(old) != now and sorted(old) == sorted(now):
            found.append(f"the readings of {name} stand in another order")
    return tuple(found)


def width(name: str) -> int:
    """The number of values for which a name in a signature stands: proximity:7 for seven, bearing for one."""
    digits = name.partition(":")[2]
    return int(digits[:MAX_WIDTH_DIGITS]) if digits.isdecimal() else 1


def places(of: Sequence[str], among: Sequence[str], counterparts: Mapping[str, str]) -> list[int]:
    """The place of each value of the names `of` among the values of the names `among`, in their order.

    `counterparts` has the name `among` them of one that is called otherwise there.
    """
    starts = dict(zip(among, accumulate(map(width, among), initial=0), strict=False))
    return [starts[counterparts.get(name, name)] + number for name in of for number in range(width(name))]


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
    places = named_places(graph)
    inputs = tuple(index for read in taught.reads for index in places[read.partition(":")[0]])
    learned = {graph.named(edge.to, edge.target): edge for edge in skill.edges if edge.output is not None}
    edges = [replace(learned[name], output=number) for number, name in enumerate(taught.sends)]
    if skill.chooses:  # of equals the first in the text: a line with at keeps its place
        rest = iter(edges)
        return replace(skill, inputs=inputs, edges=tuple(e if e.output is None else next(rest) for e in skill.edges))
    return replace(skill, inputs=inputs, edges=(*edges, *(edge for edge in skill.edges if edge.output is None)))


def _by_name(graph: Graph) -> Graph:
    """The graph with its skills parents first, otherwise by name: sums over parents are taken in this order."""
    children = {
        skill.name: [graph.named(edge.to, edge.target) for edge in skill.edges if edge.to == "skill"]
        for skill in graph.skills
    }
    order = list(lexicographical_topological_sort(DiGraph(children)))
    place = {name: index for index, name in enumerate(order)}

    def moved(edge: Edge) -> Edge:
        return replace(edge, target=place[graph.named("skill", edge.target)]) if edge.to == "skill" else edge

    skills = {skill.name: replace(skill, edges=tuple(map(moved, skill.edges))) for skill in graph.skills}
    return replace(graph, skills=tuple(skills[name] for name in order))
