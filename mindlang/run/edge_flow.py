"""What flows over each edge of a hierarchy, tick by tick, computed from what was read and thought."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from threading import Lock
from typing import Protocol

import numpy as np
from mindrun.engine.think import Hierarchy, hierarchy
from mindrun.graph.graph import Graph, Receiver
from mindrun.graph.policy import Policy
from numpy.typing import NDArray

from mindlang.run.sent_values import Places, Rows, SentValues, Singles

Sink = tuple[Receiver, int]  # which one of its kind
NOTHING = np.float32(0.0)
PART_EDGES = 1_000_000  # edges times rows that are computed at once, a few dozen bytes each


class Thought(Protocol):
    """What was read [ticks, graph.width] and the influence that it made [ticks, skills]."""

    @property
    def readings(self) -> Singles: ...
    @property
    def influence(self) -> Singles: ...


@dataclass(frozen=True, slots=True)
class Link:
    """An edge from a skill's index to a skill, an actuator or a memory."""

    source: int
    target: Sink


@dataclass(frozen=True, slots=True)
class EdgeFlow:
    """What the edges carried in some rows, each [rows, edges].

    `value` is what its skill sent, clamped; `behind` the influence of that skill; `carried` their product, as the
    engine adds it up. All are 0 where nothing was sent, and `carried` where it was cut. `transmitted` is the influence
    that came over the edge: all that is behind a command (Eq. 3), or what was carried (Eq. 2). `influence` [rows,
    skills] is what they had.
    """

    value: Singles
    behind: Singles
    carried: Singles
    transmitted: Singles
    influence: Singles


class FlowWalker:
    """What the edges of the skills of a hierarchy carry in any rows of a run, in their order.

    Rows may be asked for in any order, and by several threads; a hierarchy belongs to one walker. In the rows of
    `begins` the mind was begun anew; they are looked up when their rows are.
    """

    def __init__(self, mind: Hierarchy, rows: Rows, begins: Container[int] = ()) -> None:
        self.mind, self.rows = mind, rows
        edges = [(skill.index, edge) for skill in mind.skills for edge in skill.edges]
        self._sources = np.array([index for index, _ in edges], np.intp)
        self._drives = np.array([edge.drives for _, edge in edges], bool)
        self._cuts = np.array([-np.inf if edge.drives else edge.cuts for _, edge in edges], np.float32)
        self._values = SentValues(mind, rows, begins)
        self._walking = Lock()

    def over(self, rows: Places) -> EdgeFlow:
        """What the edges carried in rows in rising order; all at once."""
        with self._walking, np.errstate(all="ignore"):
            readings, influence = self.rows(rows)
            sent = self._values.over(rows, readings, influence)
            is_sent = np.isfinite(sent)
            behind = np.where(is_sent, influence[:, self._sources], NOTHING)
            value = np.where(is_sent & (sent > NOTHING), np.minimum(sent, np.float32(1.0)), NOTHING)
            product = value * behind
            carried = np.where(product < self._cuts, NOTHING, product)
            return EdgeFlow(value, behind, carried, np.where(self._drives, behind, carried), influence)

    def parts(self, rows: Places) -> Iterator[tuple[slice, EdgeFlow]]:
        """What flows in these rows, as many at a time as fit into memory, each part with its places among them."""
        most = max(1, PART_EDGES // max(1, len(self._sources)))
        for first in range(0, len(rows), most):
            part = slice(first, first + most)
            yield part, self.over(rows[part])

    def transmitted(self, rows: Places) -> Singles:
        """The influence over each edge [rows, edges], 0 to 1."""
        found = np.zeros((len(rows), len(self._sources)), np.float32)
        for part, flow in self.parts(rows):
            found[part] = flow.transmitted
        return found

    @property
    def kept_bytes(self) -> int:
        """How many bytes are kept of rows that have been asked for."""
        return self._values.kept_bytes

    def go_on(self, end: int) -> None:
        """Compute what remembers up to the row `end`: no row before it will be asked of `rows` any more."""
        with self._walking, np.errstate(all="ignore"):
            self._values.go_on(end)


class EdgeFlows:
    """The edges below a master, by where they lead, and what they carry in each row of a run."""

    def __init__(self, graph: Graph, walker: FlowWalker) -> None:
        self.graph, self.walker = graph, walker
        self.master = graph.skills[walker.mind.master].name
        self.skills = [skill.index for skill in walker.mind.skills]

    @cached_property
    def links(self) -> list[Link]:
        """All edges."""
        return [Link(index, (edge.to, edge.target)) for index in self.skills for edge in self.graph.skills[index].edges]

    @cached_property
    def links_to(self) -> Mapping[Sink, list[int]]:
        """The places of the links to each."""
        found: dict[Sink, list[int]] = {}
        for place, link in enumerate(self.links):
            found.setdefault(link.target, []).append(place)
        return found

    def over(self, rows: range) -> EdgeFlow:
        """What each of `links` carried in some rows, the first of which is 0; IndexError where one is not there."""
        return self.walker.over(np.array(rows, np.int64))


def edge_flows(
    policy: Policy, sources: Mapping[str, str], master: str, run: Thought, begins: Container[int] = ()
) -> EdgeFlows:
    """The flows of a run that is over; WeightsError or ProcedureError where a skill cannot be made ready."""

    def rows(places: Places) -> tuple[Singles, Singles]:
        return run.readings[places], run.influence[places]

    return EdgeFlows(policy.graph, FlowWalker(hierarchy(policy, sources, master), rows, begins))


def accumulated(edges: NDArray[np.floating]) -> Singles:
    """The sums [rows] over edges [rows, edges], as the engine adds them up: one after the other, in float32."""
    with np.errstate(all="ignore"):  # what is too large is infinite, as in the engine
        sums: NDArray[np.float32] = np.add.accumulate(edges, axis=1, dtype=np.float32)
    return sums[:, -1] if sums.shape[1] else np.zeros(len(edges), np.float32)


def sink_named(flows: EdgeFlows, name: str) -> Sink | None:
    """The skill below the master, the actuator or the memory of a name."""
    graph = flows.graph
    skills: list[tuple[str, Sink]] = [(graph.skills[index].name, ("skill", index)) for index in flows.skills]
    actuators: list[tuple[str, Sink]] = [(each.name, ("actuator", i)) for i, each in enumerate(graph.actuators)]
    memories: list[tuple[str, Sink]] = [(each.name, ("memory", i)) for i, each in enumerate(graph.memories)]
    return dict([*skills, *actuators, *memories]).get(name)
