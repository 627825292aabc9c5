"""Observations → the numbers that are read."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
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


def number_of(what: str, value: Any) -> float:
    """A number, or an array of one; TypeError where it is a text, which Python would read as one."""
    value = value.item() if isinstance(value, np.ndarray) else value
    if isinstance(value, str | bytes | bytearray):
        raise TypeError(f"{what} is the text {value!r:.40}, which is no number")
    return float(value)


def truth_of(what: str, value: Any) -> bool:
    """A truth value, or a number that is 0 or 1, or an array of one; TypeError where it is anything else."""
    value = value.item() if isinstance(value, np.ndarray | np.generic) else value
    if isinstance(value, Real) and value in (0, 1):
        return bool(value)
    raise TypeError(f"{what} is {value!r:.40}, which is neither true nor false")


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
