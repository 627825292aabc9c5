"""The arrays that an observation or an action consists of: by the names that lead to them, read and made."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np

from mindrun.kinds.environment import Slot
from mindrun.numbers.arrays import Array, Doubles, Integers

NUMBERS = "biuf"  # kinds of arrays: truth values, whole numbers, others

Place = tuple[str, int]  # of a number: the name of its part, and where it stands in the flat array of that


@dataclass(frozen=True, slots=True)
class SpacePart:
    """An array of numbers in `low` to `high` [of its size], which are infinite where a space does not say.

    Where each `is_choice`, they are whole.
    """

    shape: tuple[int, ...]
    low: Doubles
    high: Doubles
    dtype: Any
    is_choice: bool = False

    @property
    def axes(self) -> tuple[int, ...]:
        """The length along each axis; a single number is an array of one."""
        return self.shape or (1,)

    def place(self, index: tuple[int, ...]) -> int | None:
        """The place of the number with that index in the flat array; None where there is none."""
        fits = len(index) == len(self.axes) and all(i < n for i, n in zip(index, self.axes, strict=True))
        return int(np.ravel_multi_index(index, self.axes)) if fits else None

    def indices(self) -> str:
        """The indices that there are, in words."""
        return " and ".join(f"0 to {n - 1}" if n > 1 else "0" for n in self.axes)

    def values(self, numbers: Doubles) -> list[Any]:
        """Turn numbers [runs, size] into an array of its shape and type for each run; a single choice is a number."""
        values = numbers.astype(self.dtype).reshape(len(numbers), *self.shape)
        return [*values] if self.shape or self.is_choice else [np.asarray(value) for value in values]


@dataclass(frozen=True, slots=True)
class Spaces:
    """The parts of what an environment observes and of what it takes; `others` are of what it takes, and no numbers."""

    observed: Mapping[str, SpacePart]
    acted: Mapping[str, SpacePart]
    others: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PartReader:
    """The numbers at some `places` of the part of an observation to which `path` leads, read to the slots `to`."""

    path: tuple[Any, ...]
    part: SpacePart
    places: Integers
    to: Integers

    def read(self, observation: Any, out: Doubles) -> None:
        """Put them into `out` [slots]; ValueError where the observation has another shape, or no real numbers."""
        for key in self.path:
            observation = observation[key]
        seen = np.asarray(observation)
        if seen.shape != self.part.shape or seen.dtype.kind not in NUMBERS:
            raise ValueError(self._flaw(seen))
        out[self.to] = seen.reshape(-1)[self.places]

    def _flaw(self, seen: Array) -> str:
        what = f"the part {_name(self.path)} of an observation" if self.path else "an observation"
        if seen.shape != self.part.shape:
            return f"{what} has the shape {seen.shape}, and its space says {self.part.shape}"
        return f"{what} is of {seen.dtype}, which are no real numbers"


def sources_of(observed: Any, parts: Mapping[str, SpacePart], places: Sequence[Place]) -> list[PartReader]:
    """Readers of the numbers at these places, one for each slot, from observations of a space of these parts."""
    sources = []
    paths = {_name(path): path for path, _ in _leaves(observed)}
    for name in dict.fromkeys(name for name, _ in places):
        to = [slot for slot, (part, _) in enumerate(places) if part == name]
        indices = np.array([places[slot][1] for slot in to], np.int64)
        sources.append(PartReader(paths[name], parts[name], indices, np.array(to, np.int64)))
    return sources


def spaces_of(observed: Any, acted: Any) -> Spaces:
    """The parts of both spaces of an environment."""
    others = tuple(_name(path) for path, leaf in _leaves(acted) if _part(leaf) is None)
    return Spaces(parts_of(observed), parts_of(acted), others)


def parts_of(space: Any) -> dict[str, SpacePart]:
    """The parts of a space by their names, `a.b` for one in another; of a text or a graph there are none.

    The space itself has the empty name, and those of a tuple have numbers, from 0 on.
    """
    return {_name(path): part for path, leaf in _leaves(space) if (part := _part(leaf))}


def found(parts: Mapping[str, SpacePart], slot: Slot) -> tuple[str, SpacePart | None, tuple[int, ...]]:
    """The name of the part that a slot is in, that part, None where there is none, and the index in it.

    The first number of a slot in a tuple says which of its parts it is; none behind it is that of a single number.
    """
    name, index = slot.part, slot.index
    while name not in parts and index:
        name, index = f"{name}.{index[0]}".lstrip("."), index[1:]
    if name not in parts:
        return slot.part, None, slot.index
    return name, parts[name], index or (0,)


def actions_of(space: Any, acted: Mapping[str, SpacePart], numbers: Doubles) -> list[Any]:
    """The actions of a space that numbers are [runs, numbers]: those of its parts `acted`, one part after the other."""
    values, first = {}, 0
    for name, part in acted.items():
        values[name] = part.values(numbers[:, first : first + len(part.low)])
        first += len(part.low)
    return [_formed(space, {name: each[run] for name, each in values.items()}) for run in range(len(numbers))]


def _formed(space: Any, values: Mapping[str, Any], path: tuple[Any, ...] = ()) -> Any:
    """An element of a space, made of the values of its parts by their names."""
    within = _within(space)
    if within is None:
        return values[_name(path)]
    if isinstance(within, Mapping):
        return {key: _formed(inner, values, (*path, key)) for key, inner in within.items()}
    return tuple(_formed(inner, values, (*path, number)) for number, inner in enumerate(within))


def _leaves(space: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    within = _within(space)
    if within is None:
        yield path, space
        return
    for key, inner in within.items() if isinstance(within, Mapping) else enumerate(within):
        yield from _leaves(inner, (*path, key))


def _name(path: tuple[Any, ...]) -> str:
    return ".".join(map(str, path))


def _kinds(space: Any) -> set[str]:
    """The class names of a space, so that Gymnasium need not be imported."""
    return {each.__name__ for each in type(space).__mro__}


def _within(space: Any) -> Any:
    """The spaces that a space consists of; None where it does of none. One of several (OneOf) does of none."""
    return getattr(space, "spaces", None) if _kinds(space) & {"Dict", "Tuple"} else None


def _part(space: Any) -> SpacePart | None:
    kinds = _kinds(space)
    if "Box" in kinds:
        low, high = (np.asarray(end, np.float64).ravel() for end in (space.low, space.high))
        return SpacePart(tuple(space.shape), low, high, space.dtype)
    if "Discrete" in kinds:
        return _choices((), np.array([space.n]), np.array([space.start]), space.dtype)
    if "MultiDiscrete" in kinds:
        start = np.asarray(getattr(space, "start", np.zeros_like(space.nvec)))
        return _choices(tuple(space.shape), space.nvec.ravel(), start.ravel(), space.dtype)
    if "MultiBinary" in kinds:
        count = prod(space.shape)
        return _choices(tuple(space.shape), np.full(count, 2), np.zeros(count), space.dtype)
    return None


def _choices(shape: tuple[int, ...], counts: Any, start: Any, dtype: Any) -> SpacePart:
    low = np.asarray(start, np.float64)
    return SpacePart(shape, low, low + counts - 1, dtype, is_choice=True)
