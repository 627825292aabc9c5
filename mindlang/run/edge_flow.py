"""The flow over each edge of a hierarchy, tick by tick, computed by the engine's own functions."""

from collections.abc import Callable, Container, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from threading import Lock
from typing import Protocol

import numpy as np
from mindrun.engine.think import Hierarchy, ReadySkill, hierarchy, values
from mindrun.graph.graph import Graph
from mindrun.graph.graph import Sink as Sink
from mindrun.graph.policy import Policy
from mindrun.graph.scopes import influence_scopes
from mindrun.kinds.functions.function import Stateful
from mindrun.kinds.procedure_text import Sources
from numpy.typing import NDArray

Singles = NDArray[np.float32]
Places = NDArray[np.int64]  # of rows, the first of which is 0
Rows = Callable[[Places], tuple[Singles, Singles]]  # their readings [rows, width] and their influence [rows, skills]
NOTHING, NAN = np.float32(0.0), np.float32(np.nan)
BLOCK_ROWS = 1024  # of what functions that remember have sent, kept together
PART_EDGES = 1_000_000  # edges times rows that are computed at once, a few dozen bytes each


class ReadingsAndInfluence(Protocol):
    """A run as its skills had it: readings [ticks, graph.width] and the influence that they made [ticks, skills]."""

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
    """The numbers that the edges carried in some rows, each [rows, edges].

    `value` is what its skill sent, clamped; `behind` the influence of that skill; `carried` their product, as the
    engine adds it up. All are 0 where nothing was sent, and `carried` where it was cut. `transmitted` is the influence
    that came over the edge: all that is behind a command (Eq. 3), or what was carried (Eq. 2). `influence` [rows,
    skills] is what they had. Behind a command stands what of it counts for its actuator or memory.
    """

    value: Singles
    behind: Singles
    carried: Singles
    transmitted: Singles
    influence: Singles


class EdgeFlows:
    """The edges below the master of a hierarchy, and what they carry in any rows of a run.

    Rows may be asked for in any order, and by several threads; nothing else may make the hierarchy compute. In the rows
    of `begins` the mind was begun anew; they are looked up when their rows are. Of functions that remember all that was
    sent is kept: four bytes for each edge and row.
    """

    def __init__(self, graph: Graph, mind: Hierarchy, rows: Rows, begins: Container[int] = ()) -> None:
        self.graph, self.rows, self.begins = graph, rows, begins
        self.master = graph.skills[mind.master].name
        self.skills = [skill.index for skill in mind.skills]
        self.links = [
            Link(index, (edge.to, edge.target)) for index in self.skills for edge in graph.skills[index].edges
        ]
        edges = [edge for skill in mind.skills for edge in skill.edges]
        self._ready = mind.skills
        self._counts = np.array([len(skill.edges) for skill in mind.skills], np.intp)
        self._sources = np.repeat(np.array(self.skills, np.intp), self._counts)
        self._drives = np.array([edge.drives for edge in edges], bool)
        self._cuts = np.array([-np.inf if edge.drives else edge.cuts for edge in edges], np.float32)
        self._scopes = influence_scopes(graph)
        sinks = (self._scopes.of.get(link.target, 0) for link in self.links)
        self._scope_of = np.array([*sinks], np.intp)  # of the sink of each edge
        self._counts_in = [edge.scopes for edge in edges]
        remembering = [skill for skill in mind.skills if isinstance(skill.compute, Stateful)]
        self._kept = {skill.index: _Kept(skill, rows, begins) for skill in remembering}
        self._computing = Lock()

    @cached_property
    def links_to(self) -> Mapping[Sink, list[int]]:
        """The places in `links` of the edges that lead to each sink."""
        found: dict[Sink, list[int]] = {}
        for place, link in enumerate(self.links):
            found.setdefault(link.target, []).append(place)
        return found

    def flow_at(self, rows: Places | range) -> EdgeFlow:
        """The flow over `links` in rows in rising order; IndexError where one of these is not there."""
        places = np.asarray(rows, np.int64)
        with self._computing, np.errstate(all="ignore"):
            readings, influence = self.rows(places)
            sent = self._sent(places, readings, influence)
            is_sent = np.isfinite(sent)
            behind = np.where(is_sent, influence[:, self._sources], NOTHING)
            value = np.where(is_sent & (sent > NOTHING), np.minimum(sent, np.float32(1.0)), NOTHING)
            product = value * behind
            carried = np.where(product < self._cuts, NOTHING, product)
            flow = EdgeFlow(value, behind, carried, np.where(self._drives, behind, carried), influence)
            for scope in range(1, len(self._scopes.without)):
                inner, here = self._within(scope, flow), (self._scope_of == scope) & self._drives
                for of, its in ((behind, inner.behind), (carried, inner.carried), (flow.transmitted, inner.behind)):
                    of[:, here] = its[:, here]
            return flow

    def counted_for(self, sink: Sink, flow: EdgeFlow) -> EdgeFlow:
        """The part of a flow that counts for a sink: all, but where influence is over other actuators and memories."""
        scope = self._scopes.of.get(sink, 0)
        with np.errstate(all="ignore"):
            return self._within(scope, flow) if scope else flow

    def _within(self, scope: int, flow: EdgeFlow) -> EdgeFlow:
        """The flow in a scope. Influence that was replaced, and so is not what has been sent, counts in all of them."""
        own, sent = np.zeros((2, *flow.influence.shape), np.float32)
        own[:, self.skills[0]] = sent[:, self.skills[0]] = 1
        behind, carried, seen = flow.behind.copy(), flow.carried.copy(), set[int]()
        for place, (source, (_, target)) in enumerate((link.source, link.target) for link in self.links):
            if source not in seen:  # parents come first: all that it is sent is there
                seen.add(source)
                is_sent = sent[:, source] == flow.influence[:, source]
                own[:, source] = np.where(is_sent, own[:, source], flow.influence[:, source])
            behind[:, place] = np.where(flow.behind[:, place] != 0, own[:, source], NOTHING)
            product = flow.value[:, place] * behind[:, place]
            is_cut = not (self._drives[place] or scope in self._counts_in[place]) or product < self._cuts[place]
            carried[:, place] = np.where(is_cut, NOTHING, product)
            if not self._drives[place]:
                sent[:, target] += flow.carried[:, place]
                own[:, target] += carried[:, place]
        return EdgeFlow(flow.value, behind, carried, np.where(self._drives, behind, carried), own)

    def parts(self, rows: Places) -> Iterator[tuple[slice, EdgeFlow]]:
        """The flow in these rows, as many at a time as fit into memory, each part with its places among them."""
        most = max(1, PART_EDGES // max(1, len(self.links)))
        for first in range(0, len(rows), most):
            part = slice(first, first + most)
            yield part, self.flow_at(rows[part])

    def transmitted(self, rows: Places) -> Singles:
        found = np.zeros((len(rows), len(self.links)), np.float32)
        for part, flow in self.parts(rows):
            found[part] = flow.transmitted
        return found

    @property
    def kept_bytes(self) -> int:
        return sum(block.nbytes for kept in self._kept.values() for block in kept.blocks)

    def go_on(self, end: int) -> None:
        """Compute what remembers up to the row `end`: no row before it will be asked of `rows` any more."""
        with self._computing, np.errstate(all="ignore"):
            for kept in self._kept.values():
                kept.go_on(end)

    def _sent(self, rows: Places, readings: Singles, influence: Singles) -> Singles:
        """The values that each skill sent over its edges [rows, edges], before the clamp; NaN where nothing is sent."""
        is_influenced = influence[:, self.skills] != 0
        sent: list[np.float32] = []
        for row, place in np.argwhere(is_influenced).tolist():
            skill = self._ready[place]
            kept = self._kept.get(skill.index)
            sent += _numbers(skill, readings[row]) if kept is None else kept.at(int(rows[row]))
        is_computed = np.repeat(is_influenced, self._counts, axis=1)
        found = np.full(is_computed.shape, NAN)
        found[is_computed] = sent
        return found


class _Kept:
    """The values that a skill with a memory has sent so far, computed only where it is influenced, as in the engine."""

    def __init__(self, skill: ReadySkill, rows: Rows, begins: Container[int]) -> None:
        self.blocks: list[Singles] = []  # [BLOCK_ROWS, edges] each
        self._skill, self._rows, self._begins = skill, rows, begins
        self._known = 0  # how many rows are computed

    def at(self, row: int) -> list[np.float32]:
        """The values that it sent in a row."""
        self.go_on(row + 1)
        return [*self.blocks[row // BLOCK_ROWS][row % BLOCK_ROWS]]

    def go_on(self, end: int) -> None:
        """Compute the rows before `end` that are not computed yet."""
        while self._known < end:
            if self._known == len(self.blocks) * BLOCK_ROWS:
                self.blocks.append(np.full((BLOCK_ROWS, len(self._skill.edges)), NAN))
            self._fill(self.blocks[-1], np.arange(self._known, min(end, len(self.blocks) * BLOCK_ROWS)))

    def _fill(self, block: Singles, rows: Places) -> None:
        for row, readings, influence in zip(rows.tolist(), *self._rows(rows), strict=True):
            if row in self._begins and isinstance(self._skill.compute, Stateful):
                self._skill.compute.reset()
            if influence[self._skill.index] != 0:
                block[row % BLOCK_ROWS] = _numbers(self._skill, readings)
            self._known = row + 1


def _numbers(skill: ReadySkill, readings: Singles) -> list[np.float32]:
    return [NAN if value is None else value for value in values(skill, readings)]


def edge_flows(
    policy: Policy, sources: Sources, master: str, run: ReadingsAndInfluence, begins: Container[int] = ()
) -> EdgeFlows:
    """The flows of a run that is over; WeightsError or ProcedureError where a skill cannot be made ready."""

    def rows(places: Places) -> tuple[Singles, Singles]:
        return run.readings[places], run.influence[places]

    return EdgeFlows(policy.graph, hierarchy(policy, sources, master), rows, begins)


def accumulated(edges: NDArray[np.floating]) -> Singles:
    """The sums [rows] over edges [rows, edges], as the engine adds them up: one after the other, in float32."""
    with np.errstate(all="ignore"):  # what is too large is infinite, as in the engine
        sums: NDArray[np.float32] = np.add.accumulate(edges, axis=1, dtype=np.float32)
    return sums[:, -1] if sums.shape[1] else np.zeros(len(edges), np.float32)


def sink_named(flows: EdgeFlows, name: str) -> Sink | None:
    """The skill below the master, the actuator or the memory of a name."""
    graph = flows.graph
    sinks: dict[str, Sink] = {graph.skills[index].name: ("skill", index) for index in flows.skills}
    sinks |= {each.name: ("actuator", place) for place, each in enumerate(graph.actuators)}
    sinks |= {each.name: ("memory", place) for place, each in enumerate(graph.memories)}
    return sinks.get(name)
