"""What flows over each edge of a hierarchy, tick by tick, computed from what was read and thought."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Protocol

import numpy as np
from mindrun.functions.function import Stateful
from mindrun.graph import Receiver
from mindrun.policy import Policy
from mindrun.think import Ready, Sent, clamped, hierarchy, values
from numpy.typing import NDArray

Singles = NDArray[np.float32]
Sink = tuple[Receiver, int]  # which one of its kind
NOTHING = np.float32(0.0)


class Rows(Protocol):
    """What was read [ticks, graph.width] and the influence that it made [ticks, skills]; there may be more later."""

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
    """What the edges carried in one tick, each [edges].

    `value` is what its skill sent, clamped; `behind` the influence of that skill; `carried` their product, as the
    engine adds it up. All are 0 where nothing was sent, and `carried` where it was cut.
    """

    value: Singles
    behind: Singles
    carried: Singles


class EdgeFlows:
    """The edges below a master, and what they carry in each row of a run.

    In the rows of `begins` the mind was begun anew. A skill that remembers is computed from there on, so a row before
    the last that was asked for takes longer.
    """

    def __init__(
        self, policy: Policy, sources: Mapping[str, str], master: str, rows: Rows, begins: Sequence[int] = ()
    ) -> None:
        self._begins = begins
        self.graph, self.master, self.rows = policy.graph, master, rows
        self.mind = hierarchy(policy, sources, master)
        self.skills = [skill.index for skill in self.mind.skills]
        self.links = [
            Link(index, (edge.to, edge.target)) for index in self.skills for edge in self.graph.skills[index].edges
        ]
        self.links_to: dict[Sink, list[int]] = {}  # the places of the links to each
        for place, link in enumerate(self.links):
            self.links_to.setdefault(link.target, []).append(place)
        self._remembering = [skill for skill in self.mind.skills if isinstance(skill.compute, Stateful)]
        self._next = 0  # the row before which the state of these is
        self._last: tuple[int, EdgeFlow] | None = None

    def at(self, row: int) -> EdgeFlow:
        """What each of `links` carried in a row, the first of which is 0."""
        if self._last is None or self._last[0] != row:
            with np.errstate(all="ignore"):
                self._remember_until(row)
                self._last = row, self._flow(row)
            self._next = row + 1
        return self._last[1]

    def _remember_until(self, row: int) -> None:
        begin = max((each for each in self._begins if each <= row), default=0)
        if row < self._next or self._next <= begin:
            self._next = begin
            for skill in self._remembering:
                skill.compute.reset()  # type: ignore[attr-defined]
        for earlier in range(self._next, row) if self._remembering else ():
            for skill in self._remembering:
                if self.rows.influence[earlier, skill.index] != 0:
                    values(skill, self.rows.readings[earlier])

    def _flow(self, row: int) -> EdgeFlow:
        readings, influence = self.rows.readings[row], self.rows.influence[row]
        found = np.zeros((3, len(self.links)), np.float32)
        place = 0
        for skill in self.mind.skills:
            if influence[skill.index] != 0:
                self._send(skill, readings, influence[skill.index], found[:, place:])
            place += len(skill.edges)
        return EdgeFlow(*found)

    def _send(self, skill: Ready, readings: Singles, own: np.float32, found: Singles) -> None:
        """Write what a skill's edges carry into the first columns of [3, edges]."""
        for column, (edge, value) in enumerate(zip(skill.edges, values(skill, readings), strict=True)):
            if value is not None and isfinite(value):
                found[:, column] = _carried(edge, clamped(value), own)


def _carried(edge: Sent, value: np.float32, own: np.float32) -> tuple[np.float32, np.float32, np.float32]:
    carried = value * own
    is_cut = not edge.drives and carried < edge.cuts
    return value, own, NOTHING if is_cut else carried


def transmitted(edge: Sent, value: np.float32 | None, own: np.float32) -> np.float32:
    """The influence over an edge of a skill that has `own`: all of it with a command, or what is sent (Eq. 2).

    0 where nothing is sent, and where it is cut.
    """
    if value is None or not isfinite(value):
        return NOTHING
    return own if edge.drives else _carried(edge, clamped(value), own)[2]


def sink_named(flows: EdgeFlows, name: str) -> Sink | None:
    """The skill below the master, the actuator or the memory of a name."""
    graph = flows.graph
    skills: list[tuple[str, Sink]] = [(graph.skills[index].name, ("skill", index)) for index in flows.skills]
    actuators: list[tuple[str, Sink]] = [(each.name, ("actuator", i)) for i, each in enumerate(graph.actuators)]
    memories: list[tuple[str, Sink]] = [(each.name, ("memory", i)) for i, each in enumerate(graph.memories)]
    return dict([*skills, *actuators, *memories]).get(name)
