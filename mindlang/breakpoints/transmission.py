"""With what weight a skill counts in what it influences or drives, computed by the engine's own functions."""

from collections.abc import Container, Iterator, Sequence

import numpy as np
from mindrun.functions.function import Stateful
from mindrun.think import Hierarchy, Ready, values
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Transmission
from mindlang.run.edge_flow import NOTHING, transmitted

Sink = tuple[bool, int]  # where an edge goes, as the engine has it: whether it drives, and the place


class Transmissions:
    """The weights of some transmissions, row after row: a function with a memory needs every one that was before."""

    def __init__(self, asked: Sequence[Transmission], mind: Hierarchy, actuators: int) -> None:
        """The hierarchy has so many actuators, and nothing else makes its skills compute."""
        self._asked = [(each.skill, _sink(each, actuators)) for each in asked]
        sinks = {sink for _, sink in self._asked}
        self._senders = [
            skill for skill in mind.skills if not sinks.isdisjoint((edge.drives, edge.to) for edge in skill.edges)
        ]

    def feed(
        self, readings: NDArray[np.float32], influence: NDArray[np.float32], begins: Container[int] = ()
    ) -> NDArray[np.float64]:
        """The weights [transmissions, rows] over the next readings [rows, width] and influence [rows, skills].

        Toward a skill that is the influence sent to it, a summand of Eq. 2; toward what is driven, the share of the
        influence that arrives there, a weight of the mean of Eq. 3. 0 where a skill transmits nothing. In the rows of
        `begins` the mind was begun anew.
        """
        found = np.zeros((len(self._asked), len(readings)))
        with np.errstate(all="ignore"):
            for row in range(len(readings) if self._asked else 0):
                if row in begins:
                    self._begin()
                found[:, row] = self._weights(readings[row], influence[row])
        return found

    def _begin(self) -> None:
        for skill in self._senders:
            if isinstance(skill.compute, Stateful):
                skill.compute.reset()

    def _weights(self, readings: NDArray[np.float32], influence: NDArray[np.float32]) -> list[float]:
        sent: dict[tuple[int, Sink], np.float32] = {}
        arriving: dict[Sink, np.float32] = {}
        for skill in self._senders:
            for sink, passed in _sent(skill, readings, influence[skill.index]):
                sent[skill.index, sink] = sent.get((skill.index, sink), NOTHING) + passed
                arriving[sink] = arriving.get(sink, NOTHING) + passed
        return [
            float(sent[skill, sink]) / (float(arriving[sink]) if sink[0] else 1.0) if sent.get((skill, sink)) else 0.0
            for skill, sink in self._asked
        ]


def _sink(transmission: Transmission, actuators: int) -> Sink:
    return transmission.to != "skill", transmission.target + actuators * (transmission.to == "memory")


def _sent(skill: Ready, readings: NDArray[np.float32], own: np.float32) -> Iterator[tuple[Sink, np.float32]]:
    """The influence that goes over each edge of a skill."""
    if own != 0:
        for edge, value in zip(skill.edges, values(skill, readings), strict=True):
            yield (edge.drives, edge.to), transmitted(edge, value, own)
