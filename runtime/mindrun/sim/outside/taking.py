"""Observations → the numbers that are read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.sim.outside.parts import Part

NUMBERS = "biuf"  # kinds of arrays: truth values, whole numbers, others

Place = tuple[str, int]  # of a number: the name of its part, and where it stands in the flat array of that


@dataclass(frozen=True, slots=True)
class Source:
    """Numbers that are taken out of one part of an observation, at `places`, to the slots `to`."""

    name: str
    part: Part
    places: NDArray[np.int64]
    to: NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Taking:
    """What is taken out of an observation, to so many slots."""

    sources: tuple[Source, ...]
    slots: int

    def take(self, observation: Any, out: NDArray[np.float64]) -> None:
        """The numbers of an observation that are read, into `out` [slots]; ValueError where it has another shape."""
        for source in self.sources:
            seen = np.asarray(_inside(observation, source.part.path))
            if seen.shape != source.part.shape or seen.dtype.kind not in NUMBERS:
                raise ValueError(_flaw(source, seen))
            out[source.to] = seen.reshape(-1)[source.places]


def taking_of(parts: Mapping[str, Part], places: Sequence[Place]) -> Taking:
    """What takes the numbers at these places, one for each slot, out of an observation of these parts."""
    sources = []
    for name in dict.fromkeys(name for name, _ in places):
        to = [slot for slot, (part, _) in enumerate(places) if part == name]
        indices = np.array([places[slot][1] for slot in to], np.int64)
        sources.append(Source(name, parts[name], indices, np.array(to, np.int64)))
    return Taking(tuple(sources), len(places))


def _flaw(source: Source, seen: NDArray[Any]) -> str:
    """What is wrong with what was seen in the place of a part."""
    what = f"the part {source.name} of an observation" if source.name else "an observation"
    if seen.shape != source.part.shape:
        return f"{what} has the shape {seen.shape}, and its space says {source.part.shape}"
    return f"{what} is of {seen.dtype}, which are no real numbers"


def _inside(observation: Any, path: Sequence[Any]) -> Any:
    for key in path:
        observation = observation[key]
    return observation
