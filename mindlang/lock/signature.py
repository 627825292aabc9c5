"""What a genome fits, by name: taken from a graph, compared with another, and a graph in the order of its weights."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import accumulate
from typing import Any

from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.kinds.registry import arguments, names
from mindrun.kinds.sensors.sensor import SensorKind
from networkx import DiGraph, lexicographical_topological_sort

from mindlang.lock import Entry, Lock, Signature

MAX_WIDTH_DIGITS = 9  # of how many readings a sensor has, where a text from outside says it


def signature(graph: Graph, skill: Skill) -> Signature:
    """The signature of a skill that learns."""
    reads = (f"{name}:{many}" if many > 1 else name for name, many in _reads(graph, skill))
    sends = (graph.named(edge.to, edge.target) for edge in skill.edges if edge.output is not None)
    return Signature(_function(skill), tuple(reads), tuple(sends))


def differences(old: Signature, new: Signature, derived: Collection[str]) -> tuple[str, ...]:
    """What keeps weights from fitting, as sentences; order is no difference.

    The arguments in `derived` are not told where what is read or sent tells it already, from which they follow.
    """
    found = [*_read_differences(_widths(old), _widths(new)), *_changes("sends", set(old.sends), set(new.sends))]
    (old_kind, before), (new_kind, now) = _arguments(old), _arguments(new)
    if old_kind != new_kind:
        return (f"was {old_kind}, now {new_kind}", *found)
    for key in before | now:
        if before.get(key) != now.get(key) and not (key in derived and found):
            found.append(f"{key} was {before.get(key, 'not there')}, now {now.get(key, 'not there')}")
    return tuple(found)


def reordered(entry: Entry, graph: Graph) -> tuple[str, ...]:
    """The sensors that a skill reads whose readings stand in another order than in the world it was last taught in."""
    kinds = {sensor.name: sensor.kind for sensor in graph.sensors}
    read = [text.partition(":")[0] for text in entry.signature.reads]
    facts = entry.worlds[-1].facts if entry.worlds else {}
    return tuple(
        f"the readings of {name} stand in another order"
        for name in read
        if _is_reordered(facts.get(f"sensor {name}", {}).get("at"), kinds.get(name))
    )


def width(name: str) -> int:
    """How many values a name in a signature stands for: proximity:7 for seven, bearing for one."""
    digits = name.partition(":")[2]
    return int(digits[:MAX_WIDTH_DIGITS]) if digits.isdecimal() else 1


def places(of: Sequence[str], among: Sequence[str], counterparts: Mapping[str, str]) -> list[int]:
    """For each value that these names stand for its place among those of the other names, in their order.

    `counterparts` are the names among the others of those that are called otherwise there.
    """
    starts = dict(zip(among, accumulate(map(width, among), initial=0), strict=False))
    return [starts[counterparts.get(name, name)] + number for name in of for number in range(width(name))]


def _is_reordered(old: Any, now: SensorKind | None) -> bool:
    """Whether a sensor measures at the same angles, in another order."""
    if not isinstance(old, list) or now is None:
        return False
    return tuple(old) != now.directions and sorted(old) == sorted(now.directions)


def _reads(graph: Graph, skill: Skill) -> Iterator[tuple[str, int]]:
    """The names and widths of what a skill reads, in its order."""
    at = {sensor.start: (sensor.name, sensor.width) for sensor in graph.sensors}
    at |= {memory.start: (memory.name, 1) for memory in graph.memories}
    return (at[index] for index in skill.inputs if index in at)


def _function(skill: Skill) -> str:
    """The function as a phrase, every argument said: mlp hidden 2 width 14."""
    function = skill.function.explicit(len(skill.inputs), skill.outputs)
    said = (f"{each.key} {getattr(function, each.field)}" for each in arguments(type(function)))
    return " ".join([names()[type(function)], *said])


def _arguments(of: Signature) -> tuple[str, dict[str, str]]:
    kind, *words = of.function.split()
    return kind, dict(zip(words[::2], words[1::2], strict=False))


def _widths(of: Signature) -> dict[str, int]:
    return {read.partition(":")[0]: width(read) for read in of.reads}


def _read_differences(old: dict[str, int], new: dict[str, int]) -> Iterator[str]:
    yield from _changes("reads", set(old), set(new))
    for name in sorted(old.keys() & new.keys()):
        if old[name] != new[name]:
            yield f"{name} had {old[name]} reading{'s' * (old[name] != 1)}, now {new[name]}"


def _changes(verb: str, old: set[str], new: set[str]) -> Iterator[str]:
    yield from (f"{verb} {name} is new" for name in sorted(new - old))
    yield from (f"{verb} {name} is gone" for name in sorted(old - new))


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
