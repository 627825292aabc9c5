"""Updates locks after an edit: trained weights follow skills that were renamed, replaced, unshared or widened."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph, Skill
from mindrun.graph.skill_sets import owners, reachable

from mindlang.editing.project import EditError, MindChange, Replaced, Unshared
from mindlang.editing.world_names import Renaming
from mindlang.lock import Entry, Lock, Locks, Signature
from mindlang.lock.blobs import blob, digest, load_weights
from mindlang.lock.signature import places, signature, width
from mindlang.lock.status import Stale, Trained, status
from mindlang.lock.training_world import TrainingWorld

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Weights

_OF_THING = re.compile(r"(?<= of | by | to )\w+")  # the things in "26.3 reach of ball"


@dataclass(frozen=True, slots=True)
class UpdatedLocks:
    """The locks as they are after an edit, by path, and the new weights that they name, by the path of their file."""

    locks: Mapping[Path, Lock]
    weights: Mapping[Path, Weights]


def update_locks(
    locks: Locks, before: Graph, after: Graph, change: MindChange, keep_weights: bool, neighbours: Sequence[Graph] = ()
) -> UpdatedLocks:
    """The locks after an edit; with `keep_weights`, a skill that reads or influences more goes on as before.

    Some may be those of `neighbours`. EditError where a skill cannot.
    """
    names = new_names(change)
    gone = {names["skill"].get(skill.name, skill.name) for skill in before.skills}
    gone -= {skill.name for skill in after.skills}
    renaming = Renaming(names, (before, *neighbours))
    taken = set(names["skill"].values())  # by a line of a skill that was there once
    kept: dict[Path, Lock] = {}
    for path, lock in locks.items():
        entries = (_entry(entry, renaming) for name, entry in lock.items() if name not in taken)
        kept[path] = {entry.skill: entry for entry in entries if entry.skill not in gone}
    if change.replaced:
        own = {skill.name for skill in before.skills} - {change.replaced.new}
        kept = {
            path: {name: _moved(entry, change.replaced) if name in own else entry for name, entry in lock.items()}
            for path, lock in kept.items()
        }
    if change.unshared:
        kept = {path: _with_copy(lock, change.unshared, after) for path, lock in kept.items()}
    if not keep_weights and not change.recast:
        return UpdatedLocks(kept, {})
    of = None if keep_weights else {change.recast}
    return _widened(locks, kept, names["skill"], before, after, of)


def new_names(change: MindChange) -> dict[str, dict[str, str]]:
    """The renamed names of an edit: by noun, from old to new."""
    names: dict[str, dict[str, str]] = {"skill": {}}
    for rename in change.renamed:
        names.setdefault(rename.noun, {})[rename.old] = rename.new
    return names


def _entry(entry: Entry, renaming: Renaming) -> Entry:
    called = renaming.name

    def read(text: str) -> str:
        name, colon, width = text.partition(":")
        return f"{called(name, 'sensor', 'memory')}{colon}{width}"

    def skill(name: str) -> str:
        return called(name, "skill")

    signature, taught = entry.signature, entry.taught
    sends = (called(name, "skill", "actuator", "memory") for name in signature.sends)
    return replace(
        entry,
        skill=skill(entry.skill),
        signature=replace(signature, reads=tuple(map(read, signature.reads)), sends=tuple(sends)),
        taught=replace(
            taught,
            task=called(taught.task, "task"),
            master=skill(taught.master),
            curriculum=called(taught.curriculum, "curriculum"),
            happened=_OF_THING.sub(lambda found: called(found[0], "thing"), taught.happened),
        ),
        subskills=tuple(sorted((skill(name), weights) for name, weights in entry.subskills)),
        origin=entry.origin and (skill(entry.origin[0]), entry.origin[1]),
        worlds=tuple(map(renaming.relabelled, entry.worlds)),
    )


def _moved(entry: Entry, replaced: Replaced) -> Entry:
    """The line of a skill that, if it influenced another, influences the one that has taken its place."""
    sends = (replaced.new if name == replaced.old else name for name in entry.signature.sends)
    return replace(entry, signature=replace(entry.signature, sends=tuple(sends)))


def _with_copy(lock: Lock, unshared: Unshared, graph: Graph) -> dict[str, Entry]:
    """A lock with a copy of the owner's line, where it has one, for a skill that has weights of its own now.

    Who was taught with the shared weights was taught with the copy, which does the same; `graph` is the mind after the
    edit.
    """
    found = {name: _beside(entry, unshared, graph) for name, entry in lock.items()}
    if unshared.owner in lock:
        owned = found[unshared.owner]
        reads = (text.partition(":") for text in owned.signature.reads)
        read = tuple(f"{unshared.reads.get(name, name)}{colon}{wide}" for name, colon, wide in reads)
        sent = tuple(unshared.sends.get(name, name) for name in owned.signature.sends)
        own = replace(owned.signature, reads=read, sends=sent)
        found[unshared.skill] = replace(owned, skill=unshared.skill, signature=own)
    return found


def _beside(entry: Entry, unshared: Unshared, graph: Graph) -> Entry:
    """The line of a skill other than the one unshared; if taught with the shared weights, then with the copy, too."""
    shared = dict(entry.subskills).get(unshared.owner)
    worlds = tuple(_without_likeness(world, unshared.skill) for world in entry.worlds)
    if entry.skill not in graph.skill_numbers or not shared:
        return replace(entry, worlds=worlds)
    below = owners(reachable(graph, entry.skill))
    beside = dict(entry.subskills) | ({unshared.skill: shared} if unshared.skill in below else {})
    if unshared.owner not in below:
        del beside[unshared.owner]
    return replace(entry, worlds=worlds, subskills=tuple(sorted(beside.items())))


def _without_likeness(world: TrainingWorld, skill: str) -> TrainingWorld:
    """A training world in which a skill that was like another says of itself what it does."""
    fact = world.facts.get(f"skill {skill}", {})
    return TrainingWorld({**world.facts, f"skill {skill}": {"sends": fact["sends"]}}) if "like" in fact else world


def _widened(
    locks: Locks, kept: Locks, new_names: Mapping[str, str], before: Graph, after: Graph, of: Container[str] | None
) -> UpdatedLocks:
    """The locks `kept` with weights of zero for whatever a skill reads or influences beside what it was taught with.

    `locks` are those before the edit. EditError where a skill that was trained cannot go on, one `of` these if they are
    said.
    """
    weights: dict[Path, Weights] = {}
    hashes: dict[tuple[str, str], str] = {}
    wide: dict[Path, dict[str, Entry]] = {}
    old, new = ({skill.name: skill for skill in graph.skills} for graph in (before, after))
    for path, lock in kept.items():
        wide[path] = dict(lock)
        fitted = {
            new_names.get(name, name): old[name]
            for name, state in status(before, locks[path]).items()
            if isinstance(state, Trained)
        }
        for name, state in status(after, lock).items():
            if isinstance(state, Stale) and name in fitted and not new[name].like and (of is None or name in of):
                if (found := _wide(lock[name], fitted[name], after, new[name])) is None:
                    message = f"{name} cannot keep its weights: {'; '.join(state.differences)}."
                    raise EditError(message, "Leave --keep-weights out, and teach it again after the edit.")
                wide[path][name], made = found
                hashes[name, lock[name].weights] = wide[path][name].weights
                weights[blob(path.parent, wide[path][name].weights)] = made
    for lock in wide.values():  # they do the same as before: a skill that was taught with them still is
        for name, entry in lock.items():
            subskills = tuple((sub, hashes.get((sub, old), old)) for sub, old in entry.subskills)
            origin = entry.origin and (entry.origin[0], hashes.get(entry.origin, entry.origin[1]))
            lock[name] = replace(entry, subskills=subskills, origin=origin)
    return UpdatedLocks(wide, weights)


def _wide(entry: Entry, old: Skill, graph: Graph, new: Skill) -> tuple[Entry, Weights] | None:
    """An entry, and its weights, for a skill that reads and influences more; None where it is not that alone.

    It may have no input any more that no link led from.

    What is new has weights of zero, so the outputs are the same to the bit: a sum that zeros stand in is the same
    sum, and an output of zero is no influence. It is a command, though, and would be averaged, and among those of which
    a skill `chooses one` it may be the greatest: a skill that drives more, or chooses among more, has no weights that
    do the same.
    """
    weights: Weights | None = load_weights(entry, old)
    was, now = entry.signature, signature(graph, new)
    if not set(was.reads) <= set(now.reads):
        kept = [name for name in was.reads if name in now.reads]
        weights = old.function.narrowed(load_weights(entry, old), len(was.sends), places(kept, was.reads, {}))
        was = replace(was, reads=tuple(kept))
    if weights is None or not set(was.sends) <= set(now.sends):
        return None
    reads, sends = (
        (*before, *(name for name in after if name not in before))
        for before, after in ((was.reads, now.reads), (was.sends, now.sends))
    )
    influenced = {graph.named("skill", edge.target) for edge in new.edges if edge.to == "skill"}
    more = set(sends[len(was.sends) :])
    if not more <= influenced or (more and new.chooses):
        return None
    before, after = (sum(map(width, was.reads)), len(was.sends)), (sum(map(width, reads)), len(sends))
    found = old.function.widened(weights, before, new.function, after)
    if found is None and before == after:
        found = new.function.recast(weights, before, old.function)
    if found is None:
        return None
    return replace(entry, signature=Signature(now.function, reads, sends), weights=digest(found)), found
