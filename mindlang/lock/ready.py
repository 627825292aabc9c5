"""A mind with the weights that it needs to act: what `build`, `run` and `bench` begin with."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from mindrun.graph import Graph
from mindrun.weights import Weights, reachable

from mindlang.lock import read_locks
from mindlang.lock.arrange import arrange
from mindlang.lock.status import Trained, status, trained_weights
from mindlang.source import Source


@dataclass(frozen=True, slots=True)
class Ready:
    """A graph, arranged and with its master, and the weights of all skills below it; `refusals` say what is missing."""

    graph: Graph
    weights: dict[str, Weights]
    refusals: tuple[str, ...]
    notes: tuple[str, ...]


def make_ready(graph: Graph, sources: Iterable[Source], master: str | None = None) -> Ready:
    """The graph of these sources with the weights of their locks; LockError where a lock or weights are damaged."""
    lock = read_locks(source.path for source in sources)
    graph = replace(arrange(graph, lock), master=master or graph.master)
    needed = [skill.name for skill in reachable(graph, graph.master)]
    weights, refusals = trained_weights(graph, lock, needed)
    notes = (
        f"{name} was {note}"
        for name, state in status(graph, lock).items()
        if name in needed and isinstance(state, Trained)
        for note in state.notes
    )
    return Ready(graph, weights, tuple(refusals), tuple(notes))
