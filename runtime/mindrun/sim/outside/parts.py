"""The arrays that an observation or an action consists of, by the names that lead to them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.kinds.slot import Slot


@dataclass(frozen=True, slots=True)
class Part:
    """An array of numbers in `low` to `high` [of its size], which are infinite where a space does not say.

    Where there are `choices`, they are so many at each place, and the numbers are whole, from `low` on. The keys of
    `path` lead to it.
    """

    shape: tuple[int, ...]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    dtype: Any
    choices: NDArray[np.int64] | None = None
    path: tuple[Any, ...] = ()

    @property
    def axes(self) -> tuple[int, ...]:
        """How long it is along each axis; a single number is an array of one."""
        return self.shape or (1,)

    def place(self, index: tuple[int, ...]) -> int | None:
        """Where the number of that index stands in the flat array; None where there is none."""
        fits = len(index) == len(self.axes) and all(i < n for i, n in zip(index, self.axes, strict=True))
        return int(np.ravel_multi_index(index, self.axes)) if fits else None

    def indices(self) -> str:
        """The indices that there are, in words."""
        return " and ".join(f"0 to {n - 1}" if n > 1 else "0" for n in self.axes)


@dataclass(frozen=True, slots=True)
class Spaces:
    """The parts of what an environment observes and of what it takes; `others` are of what it takes, and no numbers."""

    observed: Mapping[str, Part]
    acted: Mapping[str, Part]
    others: tuple[str, ...] = ()


def spaces_of(observed: Any, acted: Any) -> Spaces:
    """The parts of both spaces of an environment."""
    return Spaces(parts_of(observed), parts_of(acted), tuple(others_of(acted)))


def parts_of(space: Any) -> dict[str, Part]:
    """The parts of a space by their names, `a.b` for one in another; of a text or a graph there are none.

    The space itself has the empty name, and those of a tuple have numbers, from 0 on.
    """
    known = ((path, _part(leaf)) for path, leaf in _leaves(space))
    return {_name(path): replace(part, path=path) for path, part in known if part is not None}


def others_of(space: Any) -> list[str]:
    """The names of the parts of a space that are no numbers."""
    return [_name(path) for path, leaf in _leaves(space) if _part(leaf) is None]


def formed(space: Any, values: Mapping[str, Any], path: tuple[Any, ...] = ()) -> Any:
    """What a space contains, made of the values of its parts by their names."""
    within = _within(space)
    if within is None:
        return values[_name(path)]
    if isinstance(within, Mapping):
        return {key: formed(inner, values, (*path, key)) for key, inner in within.items()}
    return tuple(formed(inner, values, (*path, number)) for number, inner in enumerate(within))


def difference(first: Spaces, now: Spaces) -> str:
    """How spaces differ from those that the first environment of that name had, in words; empty where they do not."""
    for what, was, parts in (("observes", first.observed, now.observed), ("takes", first.acted, now.acted)):
        for name in dict.fromkeys([*was, *parts]):
            one, other = was.get(name), parts.get(name)
            if one is None or other is None or not _are_alike(one, other):
                return f"it {what} {_described(name, other)}, and the first {_described(name, one)}"
    return "" if first.others == now.others else "it takes other texts or graphs than the first"


def _are_alike(one: Part, other: Part) -> bool:
    is_choice = one.choices is not None, other.choices is not None
    pairs = [(one.low, other.low), (one.high, other.high)] + [(one.choices, other.choices)] * all(is_choice)
    alike = is_choice[0] == is_choice[1] and one.shape == other.shape and one.dtype == other.dtype
    return alike and all(np.array_equal(a, b, equal_nan=a.dtype.kind == "f") for a, b in pairs)  # type: ignore[arg-type,union-attr]


def _described(name: str, part: Part | None) -> str:
    if part is None:
        return f"no {name}" if name else "nothing"
    numbers = f"{part.dtype} of the shape {part.shape}" + ", choices" * (part.choices is not None)
    ends = f" in {part.low.min():g} to {part.high.max():g}" if part.low.size else ""
    return f"{name}: {numbers}{ends}".removeprefix(": ")


def found(parts: Mapping[str, Part], slot: Slot) -> tuple[str, Part | None, tuple[int, ...]]:
    """The name of the part that a slot is in, that part, None where there is none, and the index in it.

    The first number of a slot in a tuple says which of its parts it is; none behind it is that of a single number.
    """
    name, index = slot.part, slot.index
    while name not in parts and index:
        name, index = f"{name}.{index[0]}".lstrip("."), index[1:]
    if name not in parts:
        return slot.part, None, slot.index
    return name, parts[name], index or (0,)


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
    """What a space is, by name: Gymnasium need not be imported for it."""
    return {each.__name__ for each in type(space).__mro__}


def _within(space: Any) -> Any:
    """The spaces that a space consists of; None where it does of none. One of several (OneOf) does of none."""
    return getattr(space, "spaces", None) if _kinds(space) & {"Dict", "Tuple"} else None


def _part(space: Any) -> Part | None:
    kinds = _kinds(space)
    if "Box" in kinds:
        low, high = (np.asarray(end, np.float64).ravel() for end in (space.low, space.high))
        return Part(tuple(space.shape), low, high, space.dtype)
    if "Discrete" in kinds:
        return _choices((), np.array([space.n]), np.array([space.start]), space.dtype)
    if "MultiDiscrete" in kinds:
        start = np.asarray(getattr(space, "start", np.zeros_like(space.nvec)))
        return _choices(tuple(space.shape), space.nvec.ravel(), start.ravel(), space.dtype)
    if "MultiBinary" in kinds:
        count = prod(space.shape)
        return _choices(tuple(space.shape), np.full(count, 2), np.zeros(count), space.dtype)
    return None


def _choices(shape: tuple[int, ...], counts: Any, start: Any, dtype: Any) -> Part:
    low = np.asarray(start, np.float64)
    return Part(shape, low, low + counts - 1, dtype, np.asarray(counts, np.int64))
