"""With what weight a skill counts in what it influences or drives, computed by the engine's own functions."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from mindrun.engine.think import Hierarchy
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Transmission
from mindlang.run.edge_flow import EdgeFlow, FlowWalker, accumulated
from mindlang.run.sent_values import Places, Singles

Sink = tuple[bool, int]  # where an edge goes, as the engine has it: whether it drives, and the place


@dataclass(frozen=True, slots=True)
class _Asked:
    """A transmission, by the places of its edges, and of all to the same: whether that is driven."""

    own: tuple[int, ...]
    all: tuple[int, ...]
    is_driven: bool


class Transmissions:
    """The weights of some transmissions, row after row: a function with a memory needs every one that was before."""

    def __init__(self, asked: Sequence[Transmission], mind: Hierarchy, actuators: int) -> None:
        """The hierarchy has so many actuators, and nothing else makes its skills compute."""
        sinks = {_sink(each, actuators) for each in asked}
        senders = [
            skill for skill in mind.skills if not sinks.isdisjoint((edge.drives, edge.to) for edge in skill.edges)
        ]
        edges: dict[Sink, list[tuple[int, int]]] = {}  # the places of the edges to each, and their skills
        for place, (sender, edge) in enumerate((skill.index, edge) for skill in senders for edge in skill.edges):
            edges.setdefault((edge.drives, edge.to), []).append((place, sender))
        self._asked = [_asked(edges.get(_sink(each, actuators), []), each) for each in asked]
        self._begins: set[int] = set()
        self._walker = FlowWalker(replace(mind, skills=tuple(senders)), self._rows, self._begins)
        self._fed = 0  # rows, before those of now
        self._now: tuple[Singles, Singles]  # those rows

    def feed(self, readings: Singles, influence: Singles, begins: Iterable[int] = ()) -> NDArray[np.float64]:
        """The weights [transmissions, rows] over the next readings [rows, width] and influence [rows, skills].

        Toward a skill that is the influence sent to it, a summand of Eq. 2; toward what is driven, the share of the
        influence that arrives there, a weight of the mean of Eq. 3. 0 where a skill transmits nothing. In the rows of
        `begins` the mind was begun anew.
        """
        self._now = readings, influence
        self._begins.update(self._fed + int(row) for row in begins)
        found = np.zeros((len(self._asked), len(readings)))
        end = self._fed + len(readings)
        if self._asked:
            for part, flow in self._walker.parts(np.arange(self._fed, end)):
                found[:, part] = [_weights(flow, each) for each in self._asked]
            self._walker.go_on(end)
        self._fed = end
        return found

    def _rows(self, rows: Places) -> tuple[Singles, Singles]:
        readings, influence = self._now
        return readings[rows - self._fed], influence[rows - self._fed]


def _asked(edges: Sequence[tuple[int, int]], transmission: Transmission) -> _Asked:
    own = tuple(place for place, skill in edges if skill == transmission.skill)
    return _Asked(own, tuple(place for place, _ in edges), transmission.to != "skill")


def _weights(flow: EdgeFlow, asked: _Asked) -> NDArray[np.float64]:
    sent = accumulated(flow.transmitted[:, asked.own]).astype(np.float64)
    if not asked.is_driven:
        return sent
    with np.errstate(all="ignore"):
        return np.where(sent == 0, 0.0, sent / accumulated(flow.transmitted[:, asked.all]).astype(np.float64))


def _sink(transmission: Transmission, actuators: int) -> Sink:
    return transmission.to != "skill", transmission.target + actuators * (transmission.to == "memory")
