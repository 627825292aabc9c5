"""What becomes of trained weights when their source is edited: a line of the lock says the same with other names."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from mindrun.functions import Mlp
from mindrun.functions.mlp import layers, matrices
from mindrun.graph import Graph, Skill
from mindrun.weights import Weights

from mindlang.editing.project import Change, Renamed
from mindlang.lock import Entry, Lock, Signature, lock_path, read_lock
from mindlang.lock.blobs import blob, digest, load_weights
from mindlang.lock.signature import signature
from mindlang.lock.status import Stale, status

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
    """The locks after an edit; with `keep_weights`, a skill that reads or sends more keeps what it does without that."""
    renamed = {path: _relabelled(lock, change.renamed) for path, lock in locks.items()}
    gone = {skill.name for skill in before.skills} - {skill.name for skill in after.skills}
    gone -= {rename.old for rename in change.renamed}
    kept = {path: {name: entry for name, entry in lock.items() if name not in gone} for path, lock in renamed.items()}
    return _widened(kept, before, after, change) if keep_weights else Followed(kept, {})


def _relabelled(lock: Lock, renamed: Iterable[Renamed]) -> dict[str, Entry]:
    names: dict[str, dict[str, str]] = {}
    for rename in renamed:
        names.setdefault(rename.noun, {})[rename.old] = rename.new
    entries = (_entry(entry, names) for entry in lock.values())
    return {entry.skill: entry for entry in entries}


def _entry(entry: Entry, names: Mapping[str, Mapping[str, str]]) -> Entry:
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


def _widened(locks: dict[Path, dict[str, Entry]], before: Graph, after: Graph, change: Change) -> Followed:
    """The locks with weights of zero for whatever a skill reads or sends beside what it was taught with."""
    weights: dict[Path, Weights] = {}
    hashes: dict[tuple[str, str], str] = {}
    old_names = {rename.new: rename.old for rename in change.renamed if rename.noun == "skill"}
    skills = {skill.name: skill for skill in after.skills}
    olds = {skill.name: skill for skill in before.skills}
    for name, state in status(after, merged(locks)).items():
        if not isinstance(state, Stale):
            continue
        for path, lock in locks.items():
            old = olds.get(old_names.get(name, name))
            if name in lock and old and (wide := widened(lock[name], old, after, skills[name])):
                hashes[name, lock[name].weights] = wide[0].weights
                lock[name] = wide[0]
                weights[blob(path.parent, wide[0].weights)] = wide[1]
    return Followed({path: _taught_with(lock, hashes) for path, lock in locks.items()}, weights)


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
    reads, sends = list(was.reads), list(was.sends)
    influenced = {graph.named("skill", edge.target) for edge in new.edges if edge.to == "skill"}
    if not (set(reads) <= set(now.reads) and set(sends) <= set(now.sends) <= set(sends) | influenced):
        return None
    reads += [read for read in now.reads if read not in reads]
    sends += [send for send in now.sends if send not in sends]
    if not isinstance(old.function, Mlp) or not isinstance(new.function, Mlp):
        return None
    before = layers(_width(was.reads), len(was.sends), old.function)
    after = layers(_width(tuple(reads)), len(sends), new.function)
    if len(before) != len(after) or any(
        o > n for pair in zip(before, after, strict=True) for o, n in zip(*pair, strict=True)
    ):
        return None
    weights = _embedded(load_weights(entry, old), before, after)
    made = replace(entry, signature=Signature(now.function, tuple(reads), tuple(sends)), weights=digest(weights))
    return made, weights


def _embedded(genome: Weights, before: tuple[tuple[int, int], ...], after: tuple[tuple[int, int], ...]) -> Weights:
    """A genome in a larger one whose other weights are zero."""
    larger = [np.zeros((out, into), np.float32) for into, out in after]
    for large, small in zip(larger, matrices(genome, before), strict=True):
        large[: small.shape[0], : small.shape[1]] = small
    return np.concatenate([large.ravel() for large in larger])


def _width(reads: tuple[str, ...]) -> int:
    return sum(int(width) if width else 1 for _, _, width in (read.partition(":") for read in reads))
