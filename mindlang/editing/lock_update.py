"""Updates locks after an edit: trained weights follow renamed, replaced and widened skills."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph

from mindlang.editing.project import MindChange, Replaced
from mindlang.editing.unshared import with_copy
from mindlang.editing.widen import widen_locks
from mindlang.editing.world_names import Renaming
from mindlang.lock import Entry, Lock, lock_path, read_lock

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Weights

Locks = Mapping[Path, Lock]  # by the path of the lock


@dataclass(frozen=True, slots=True)
class UpdatedLocks:
    """The locks as they are after an edit, by path, and the new weights that they name, by the path of their file."""

    locks: Mapping[Path, Lock]
    weights: Mapping[Path, Weights]


def locks_of(sources: Iterable[Path]) -> dict[Path, dict[str, Entry]]:
    """The locks of files, by their paths; LockError where one is damaged."""
    return {path: read_lock(path) for path in map(lock_path, sources)}


def merged(locks: Locks, sources: Iterable[Path]) -> Lock:
    """What the locks of these files say, the first that knows a skill; main file first."""
    known: dict[str, Entry] = {}
    for path in map(lock_path, sources):
        known = {**locks.get(path, {}), **known}
    return known


def update_locks(
    locks: Locks,
    before: Graph,
    after: Graph,
    change: MindChange,
    keep_weights: bool,
    neighbours: Sequence[Graph] = (),
) -> UpdatedLocks:
    """The locks after an edit; with `keep_weights`, a skill that reads or influences more goes on as before.

    Some may be those of `neighbours`. EditError where a skill cannot.
    """
    names = new_names(change)
    gone = {names["skill"].get(skill.name, skill.name) for skill in before.skills}
    gone -= {skill.name for skill in after.skills}
    renaming = Renaming(names, (before, *neighbours))
    kept = {path: _relabelled(lock, renaming, gone) for path, lock in locks.items()}
    if change.replaced:
        own = {skill.name for skill in before.skills} - {change.replaced.new}
        kept = {path: _moved(lock, change.replaced, own) for path, lock in kept.items()}
    if change.unshared:
        kept = {path: with_copy(lock, change.unshared, after) for path, lock in kept.items()}
    return (
        UpdatedLocks(*widen_locks(locks, kept, names["skill"], before, after))
        if keep_weights
        else UpdatedLocks(kept, {})
    )


def new_names(change: MindChange) -> dict[str, dict[str, str]]:
    """The renamed names of an edit: by noun, from old to new."""
    names: dict[str, dict[str, str]] = {"skill": {}}
    for rename in change.renamed:
        names.setdefault(rename.noun, {})[rename.old] = rename.new
    return names


def _relabelled(lock: Lock, renaming: Renaming, gone: set[str]) -> dict[str, Entry]:
    """A lock with new names, without the lines of skills that are gone."""
    taken = set(renaming.names["skill"].values())  # by a line of a skill that was there once
    entries = (_entry(entry, renaming) for name, entry in lock.items() if name not in taken)
    return {entry.skill: entry for entry in entries if entry.skill not in gone}


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
        ),
        subskills=tuple(sorted((skill(name), weights) for name, weights in entry.subskills)),
        origin=entry.origin and (skill(entry.origin[0]), entry.origin[1]),
        worlds=tuple(map(renaming.relabelled, entry.worlds)),
    )


def _moved(lock: Lock, replaced: Replaced, parents: Set[str]) -> dict[str, Entry]:
    """A lock in which those of `parents` that influenced a skill influence the one that has taken its place."""
    return {name: _moved_entry(entry, replaced) if name in parents else entry for name, entry in lock.items()}


def _moved_entry(entry: Entry, replaced: Replaced) -> Entry:
    sends = (replaced.new if name == replaced.old else name for name in entry.signature.sends)
    return replace(entry, signature=replace(entry.signature, sends=tuple(sends)))
