"""Widens trained weights: a skill reads and influences more than before, and still computes the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from mindrun.graph.graph import Graph, Skill

from mindlang.editing.project import EditError
from mindlang.lock import Entry, Lock, Signature
from mindlang.lock.blobs import blob, digest, load_weights
from mindlang.lock.signature import signature, width
from mindlang.lock.status import Stale, Trained, status

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Weights

Locks = Mapping[Path, Lock]


def widen_locks(
    locks: Locks, kept: Locks, new_names: Mapping[str, str], before: Graph, after: Graph
) -> tuple[Locks, Mapping[Path, Weights]]:
    """The locks `kept` with weights of zero for whatever a skill reads or influences beside what it was taught with.

    `locks` are those before the edit. Also the new weights, by the path of their file. EditError where a skill that was
    trained cannot go on.
    """
    weights: dict[Path, Weights] = {}
    hashes: dict[tuple[str, str], str] = {}
    wide: dict[Path, dict[str, Entry]] = {}
    skills = {skill.name: skill for skill in after.skills}
    for path, lock in kept.items():
        wide[path] = dict(lock)
        fitted = _fitted(locks[path], new_names, before)
        for name, state in status(after, lock).items():
            if isinstance(state, Stale) and name in fitted and not skills[name].like:
                entry = lock[name]
                wide[path][name], made = widen(entry, fitted[name], after, skills[name]) or _refuse(name, state)
                hashes[name, entry.weights] = wide[path][name].weights
                weights[blob(path.parent, wide[path][name].weights)] = made
    return {path: _taught_with(lock, hashes) for path, lock in wide.items()}, weights


def _fitted(lock: Lock, new_names: Mapping[str, str], before: Graph) -> dict[str, Skill]:
    """The skills whose weights fitted before the edit, by the names that they have after it."""
    skills = {skill.name: skill for skill in before.skills}
    return {
        new_names.get(name, name): skills[name]
        for name, state in status(before, lock).items()
        if isinstance(state, Trained)
    }


def _refuse(skill: str, state: Stale) -> NoReturn:
    raise EditError(
        f"{skill} cannot keep its weights: {'; '.join(state.differences)}.",
        "Leave --keep-weights out, and teach it again after the edit.",
    )


def _taught_with(lock: Lock, hashes: Mapping[tuple[str, str], str]) -> dict[str, Entry]:
    """Widened subskills do the same as before: a skill that was taught with them still is."""
    return {
        name: replace(
            entry,
            subskills=tuple((sub, hashes.get((sub, old), old)) for sub, old in entry.subskills),
            origin=entry.origin and (entry.origin[0], hashes.get(entry.origin, entry.origin[1])),
        )
        for name, entry in lock.items()
    }


def widen(entry: Entry, old: Skill, graph: Graph, new: Skill) -> tuple[Entry, Weights] | None:
    """An entry, and its weights, for a skill that reads and influences more; None where it is not that alone.

    What is new has weights of zero, so the outputs are the same to the bit: a sum that zeros stand in is the same
    sum, and an output of zero is no influence. It is a command, though, and would be averaged: a skill that drives more
    has no weights that do the same.
    """
    was, now = entry.signature, signature(graph, new)
    reads, sends = _longer(was.reads, now.reads), _longer(was.sends, now.sends)
    influenced = {graph.named("skill", edge.target) for edge in new.edges if edge.to == "skill"}
    if reads is None or sends is None or not set(sends[len(was.sends) :]) <= influenced:
        return None
    before, after = (sum(map(width, was.reads)), len(was.sends)), (sum(map(width, reads)), len(sends))
    if type(old.function) is not type(new.function):
        return None
    weights = old.function.widened(load_weights(entry, old), before, new.function, after)
    if weights is None:
        return None
    made = replace(entry, signature=Signature(now.function, reads, sends), weights=digest(weights))
    return made, weights


def _longer(old: tuple[str, ...], new: tuple[str, ...]) -> tuple[str, ...] | None:
    """The old names in their order, then those that are new; None where one is gone."""
    return (*old, *(name for name in new if name not in old)) if set(old) <= set(new) else None
