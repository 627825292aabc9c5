"""The locks after a skill that was like another has got weights of its own: a copy, which does the same."""

from collections.abc import Mapping
from dataclasses import replace

from mindrun.graph.graph import Graph
from mindrun.graph.skill_sets import owners, reachable

from mindlang.editing.project import Unshared
from mindlang.lock import Entry, Lock, Signature
from mindlang.lock.training_world import TrainingWorld


def with_copy(lock: Lock, unshared: Unshared, graph: Graph) -> dict[str, Entry]:
    """A lock with a line for the skill where it has one of the owner; `graph` is the mind after the edit.

    Who was taught with the shared weights was taught with the copy.
    """
    found = {name: _beside(entry, unshared, graph) for name, entry in lock.items()}
    if owned := lock.get(unshared.owner):
        found[unshared.skill] = replace(
            found[unshared.owner], skill=unshared.skill, signature=_signature(owned.signature, unshared.instead)
        )
    return found


def _signature(owned: Signature, instead: Mapping[str, str]) -> Signature:
    reads = (text.partition(":") for text in owned.reads)
    return replace(owned, reads=tuple(f"{instead.get(name, name)}{colon}{width}" for name, colon, width in reads))


def _beside(entry: Entry, unshared: Unshared, graph: Graph) -> Entry:
    """A line of a skill that may have been taught with the shared weights."""
    shared = dict(entry.subskills).get(unshared.owner)
    worlds = tuple(_world(world, unshared.skill) for world in entry.worlds)
    if entry.skill not in {skill.name for skill in graph.skills} or not shared:
        return replace(entry, worlds=worlds)
    below = owners(reachable(graph, entry.skill))
    beside = dict(entry.subskills) | ({unshared.skill: shared} if unshared.skill in below else {})
    if unshared.owner not in below:
        del beside[unshared.owner]
    return replace(entry, worlds=worlds, subskills=tuple(sorted(beside.items())))


def _world(world: TrainingWorld, skill: str) -> TrainingWorld:
    """A training world in which a skill that was like another says of itself what it does."""
    subject = f"skill {skill}"
    if "like" not in world.facts.get(subject, {}):
        return world
    return TrainingWorld({**world.facts, subject: {"sends": world.facts[subject]["sends"]}})
