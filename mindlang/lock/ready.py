"""A mind with the weights that it needs to act: what `build`, `run` and `bench` begin with."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph
from mindrun.graph.skill_sets import reachable

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.source import Source
from mindlang.lock import lock_sources, read_locks
from mindlang.lock.signature import arrange
from mindlang.lock.status import UNKNOWN, Status, Trained, status, trained_weights

if TYPE_CHECKING:
    from mindrun.graph.policy import Policy


@dataclass(frozen=True, slots=True)
class ReadyMind:
    """A policy, with its master and the weights of all skills below it; `refusals` say what is missing.

    `notes` say which of these skills were taught in a world that is not the mind's, or is not known.
    """

    policy: Policy
    refusals: tuple[str, ...]
    notes: tuple[str, ...]


def make_ready(graph: Graph, sources: Iterable[Source], master: str | None = None) -> ReadyMind:
    """The graph of these sources with the weights of their locks; LockError where a lock or weights are damaged."""
    from mindrun.graph.policy import Policy  # which needs numpy

    sources = tuple(sources)
    lock = read_locks(lock_sources(sources))
    graph = replace(arrange(graph, lock), master=master or graph.master)
    needed = [skill.name for skill in reachable(graph, graph.master)]
    weights, refusals = trained_weights(graph, lock, frozenset(needed))
    states = status(graph, lock, sources[0].folder)
    acting = {name: states[name] for name in needed}
    notes = [*elsewhere_sentences(acting)]
    if unknown := [name for name, state in acting.items() if isinstance(state, Trained) and not state.entry.worlds]:
        notes.append(f"{_were_taught(unknown)} {UNKNOWN}")
    return ReadyMind(Policy(graph, weights), tuple(refusals), tuple(notes))


def elsewhere_sentences(states: Mapping[str, Status]) -> Iterator[str]:
    """A sentence for all skills that were taught elsewhere in the same way."""
    ways: dict[tuple[str, ...], list[str]] = {}
    for name, state in states.items():
        if isinstance(state, Trained) and state.is_elsewhere:
            ways.setdefault(state.changes, []).append(name)
    for changes, skills in ways.items():
        yield f"{_were_taught(skills)} elsewhere: {'; '.join(changes)}"


def _were_taught(skills: Sequence[str]) -> str:
    return f"{listed(skills, 'and')} {'was' if len(skills) == 1 else 'were'} taught"
