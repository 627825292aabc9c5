"""Which skills of a mind have weights that fit, and what is different about those that do not."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from mindrun.functions import Mlp
from mindrun.graph import Graph, Skill
from mindrun.weights import Weights, below, genes

from mindlang.lock import Entry, Lock
from mindlang.lock.blobs import load_weights
from mindlang.lock.signature import differences, signature


@dataclass(frozen=True, slots=True)
class Trained:
    """Its weights fit. The notes say which subskills are others than those that it was taught with."""

    entry: Entry
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Stale:
    """Its weights belong to another declaration; each difference is a sentence."""

    differences: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Untaught:
    """It learns, and has no weights yet."""


@dataclass(frozen=True, slots=True)
class NotLearning:
    """It has no weights to learn."""


Status = Trained | Stale | Untaught | NotLearning


def status(graph: Graph, lock: Lock) -> dict[str, Status]:
    """How each skill of a mind stands to its lock; reads no weights."""
    return {skill.name: _status(graph, index, lock) for index, skill in enumerate(graph.skills)}


def _status(graph: Graph, index: int, lock: Lock) -> Status:
    skill = graph.skills[index]
    if genes(skill) == 0:
        return NotLearning()
    entry = lock.get(skill.name)
    if entry is None:
        return Untaught()
    found = differences(entry.signature, signature(graph, skill), _width_is_derived(skill))
    return Stale(found) if found else Trained(entry, tuple(_notes(below(graph, index)[1:], entry, lock)))


def _width_is_derived(skill: Skill) -> bool:
    return isinstance(skill.function, Mlp) and skill.function.width == 0


def _notes(subskills: Collection[Skill], entry: Entry, lock: Lock) -> Iterator[str]:
    names = {skill.name for skill in subskills}
    for skill, weights in entry.subskills:
        now = lock.get(skill)
        if skill not in names:
            yield f"taught with {skill} ({weights[:4]}…), which is not below it now"
        elif now is None:
            yield f"taught with {skill} ({weights[:4]}…), which has no weights now"
        elif now.weights != weights:
            yield f"taught with another {skill} ({weights[:4]}…, now {now.weights[:4]}…)"
    known = {skill for skill, _ in entry.subskills}
    yield from (f"taught without {skill.name}" for skill in subskills if genes(skill) and skill.name not in known)


def trained_weights(graph: Graph, lock: Lock, skills: Collection[str]) -> tuple[dict[str, Weights], list[str]]:
    """The weights of those of `skills` that learn, and a message for each that has none or stale ones.

    The graph must be `arrange`d. LockError where a file of weights is damaged.
    """
    weights: dict[str, Weights] = {}
    refusals = []
    states = status(graph, lock)
    for skill in graph.skills:
        if skill.name not in skills:
            continue
        frozen = " (and is frozen: unfreeze it first)" * skill.frozen
        match states[skill.name]:
            case Trained(entry):
                weights[skill.name] = load_weights(entry, skill)
            case Stale(found):
                refusals.append(f"the weights of {skill.name} are stale: {'; '.join(found)}{frozen}")
            case Untaught():
                refusals.append(f"{skill.name} has not been taught{frozen}")
    return weights, refusals
