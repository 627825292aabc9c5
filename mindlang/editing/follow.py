"""What becomes of trained weights when their source is edited: a line of the lock says the same with other names."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

import numpy as np
from mindrun.functions import Mlp
from mindrun.functions.mlp import layers, matrices
from mindrun.graph import Graph, Skill
from mindrun.weights import Weights

from mindlang.editing.project import Change, EditError, Renamed
from mindlang.lock import Entry, Lock, Signature, lock_path, read_lock
from mindlang.lock.blobs import blob, digest, load_weights
from mindlang.lock.signature import signature
from mindlang.lock.status import Stale, Trained, status

Locks = Mapping[Path, Lock]  # by the path of the lock


@dataclass(frozen=True, slots=True)
class Followed:
    """The locks as they are after an edit, by path, and the new weights that they name, by the path of their file."""

    locks: dict[Path, dict[str, Entry]]
    weights: dict[Path, Weights]


def locks_of(sources: Iterable[Path]) -> dict[Path, dict[str, Entry]]:
    """The locks of files, by their paths; LockError where one is damaged."""
    return {path: read_lock(path) for path in map(lock_path, sources)}


def merged(locks: Locks) -> Lock:
    """What all locks say, the first that knows a skill."""
    known: dict[str, Entry] = {}
    for lock in locks.values():
        known = {**lock, **known}
    return known


def follow(locks: Locks, before: Graph, after: Graph, change: Change, keep_weights: bool) -> Followed:
    """The locks after an edit; with `keep_weights`, a skill that reads or sends more keeps what it does without that.

    EditError where a skill cannot.
    """
    renamed = {path: _relabelled(lock, change.renamed) for path, lock in locks.items()}
    gone = {skill.name for skill in before.skills} - {skill.name for skill in after.skills}
    gone -= {rename.old for rename in change.renamed}
    kept = {path: {name: entry for name, entry in lock.items() if name not in gone} for path, lock in renamed.items()}
    if not keep_weights:
        return Followed(kept, {})
    old_names = {rename.new: rename.old for rename in change.renamed if rename.noun == "skill"}
    stood = {path: status(before, lock) for path, lock in locks.items()}
    olds = {skill.name: skill for skill in before.skills}
    fitted = {
        path: {
            name: olds[old]
            for name in lock
            if (old := old_names.get(name, name)) in olds and isinstance(stood[path][old], Trained)
        }
        for path, lock in kept.items()
    }
    return _widened(kept, fitted, after)


def _relabelled(lock: Lock, renamed: Iterable[Renamed]) -> dict[str, Entry]:
    names: dict[str, dict[str, str]] = {}
    for rename in renamed:
        names.setdefault(rename.noun, {})[rename.old] = rename.new
    taken = set(names.get("skill", {}).values())  # by a line of a skill that was there once
    entries = (_entry(entry, names) for name, entry in lock.items() if name not in taken)
    return {entry.skill: entry for entry in entries}


def _entry(entry: Entry, names: Mapping[str, Mapping[str, str]]) -> Entry:
    # A skill that takes the place of another may influence it, and goes on doing so.
    below = {old: new for old, new in names.get("influence", {}).items() if new != entry.skill}
    names = {**names, "influence": below}

    def now(name: str, *nouns: str) -> str:
        return next((names[noun][name] for noun in nouns if name in names.get(noun, {})), name)

    def read(text: str) -> str:
        name, colon, width = text.partition(":")
        return f"{now(name, 'sensor', 'memory')}{colon}{width}"

    reads = tuple(map(read, entry.signature.reads))
    sends = tuple(now(name, "influence", "skill", "actuator", "memory") for name in entry.signature.sends)
    taught = replace(entry.taught, task=now(entry.taught.task, "task"), master=now(entry.taught.master, "skill"))
    return replace(
        entry,
        skill=now(entry.skill, "skill"),
        signature=replace(entry.signature, reads=reads, sends=sends),
        taught=taught,
        subskills=tuple(sorted((now(skill, "influence", "skill"), weights) for skill, weights in entry.subskills)),
    )


def _widened(locks: dict[Path, dict[str, Entry]], fitted: Mapping[Path, Mapping[str, Skill]], after: Graph) -> Followed:
    """The locks with weights of zero for whatever a skill reads or sends beside what it was taught with."""
    weights: dict[Path, Weights] = {}
    hashes: dict[tuple[str, str], str] = {}
    skills = {skill.name: skill for skill in after.skills}
    for path, lock in locks.items():
        for name, state in status(after, lock).items():
            if not isinstance(state, Stale) or name not in fitted[path]:
                continue
            entry = lock[name]
            lock[name], made = widened(entry, fitted[path][name], after, skills[name]) or _refuse(name, state)
            hashes[name, entry.weights] = lock[name].weights
            weights[blob(path.parent, lock[name].weights)] = made
    return Followed({path: _taught_with(lock, hashes) for path, lock in locks.items()}, weights)


def _refuse(skill: str, state: Stale) -> NoReturn:
    raise EditError(
        f"{skill} cannot keep its weights: {'; '.join(state.differences)}.",
        "Leave --keep-weights out, and teach it again after the edit.",
    )


def _taught_with(lock: Lock, hashes: Mapping[tuple[str, str], str]) -> dict[str, Entry]:
    """Widened subskills do the same as before: a skill that was taught with them still is."""
    return {
        name: replace(entry, subskills=tuple((sub, hashes.get((sub, old), old)) for sub, old in entry.subskills))
        for name, entry in lock.items()
    }


def widened(entry: Entry, old: Skill, graph: Graph, new: Skill) -> tuple[Entry, Weights] | None:
    """An entry, and its weights, for a skill that reads and influences more; None where it is not that alone.

    What is new has weights of zero, so the outputs are the same to the bit: a sum that is followed by zeros is the same
    sum, and an output of zero is no influence. It is a command, though, and would be averaged: a skill that drives more
    has no weights that do the same.
    """
    was, now = entry.signature, signature(graph, new)
    reads, sends = _longer(was.reads, now.reads), _longer(was.sends, now.sends)
    influenced = {graph.named("skill", edge.target) for edge in new.edges if edge.to == "skill"}
    if reads is None or sends is None or not set(sends[len(was.sends) :]) <= influenced:
        return None
    if not isinstance(old.function, Mlp) or not isinstance(new.function, Mlp):
        return None
    before = layers(_width(was.reads), len(was.sends), old.function)
    after = layers(_width(reads), len(sends), new.function)
    if len(before) != len(after) or any(map(_is_smaller, after, before)):
        return None
    weights = _embedded(load_weights(entry, old), before, after)
    made = replace(entry, signature=Signature(now.function, reads, sends), weights=digest(weights))
    return made, weights


def _longer(old: tuple[str, ...], new: tuple[str, ...]) -> tuple[str, ...] | None:
    """The old names in their order, then those that are new; None where one is gone."""
    return (*old, *(name for name in new if name not in old)) if set(old) <= set(new) else None


def _is_smaller(layer: tuple[int, int], than: tuple[int, int]) -> bool:
    return layer[0] < than[0] or layer[1] < than[1]


def _embedded(genome: Weights, before: tuple[tuple[int, int], ...], after: tuple[tuple[int, int], ...]) -> Weights:
    """A genome in a larger one whose other weights are zero."""
    larger = [np.zeros((out, into), np.float32) for into, out in after]
    for large, small in zip(larger, matrices(genome, before), strict=True):
        large[: small.shape[0], : small.shape[1]] = small
    return np.concatenate([large.ravel() for large in larger])


def _width(reads: tuple[str, ...]) -> int:
    return sum(int(width) if width else 1 for _, _, width in (read.partition(":") for read in reads))
