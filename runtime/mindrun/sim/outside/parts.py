"""The arrays that an observation or an action consists of, by the names that lead to them."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Part:
    """An array of numbers in `low` to `high` [of its size], which are infinite where a space does not say.

    Where there are `choices`, they are so many at each place, and the numbers are whole, from `low` on.
    """

    shape: tuple[int, ...]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    dtype: Any
    choices: NDArray[np.int64] | None = None

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


def parts_of(space: Any, name: str = "") -> dict[str, Part]:
    """The parts of a space by their names, `a.b` for one in another; of a text or a graph there are none.

    The space itself has the empty name.
    """
    if isinstance(getattr(space, "spaces", None), Mapping):
        inner = ((f"{name}.{key}".lstrip("."), value) for key, value in space.spaces.items())
        return {key: part for below, value in inner for key, part in parts_of(value, below).items()}
    part = _part(space)
    return {} if part is None else {name: part}


def _part(space: Any) -> Part | None:
    match type(space).__name__:
        case "Box":
            low, high = (np.asarray(end, np.float64).ravel() for end in (space.low, space.high))
            return Part(tuple(space.shape), low, high, space.dtype)
        case "Discrete":
            return _choices((), np.array([space.n]), np.array([space.start]), space.dtype)
        case "MultiDiscrete":
            start = np.asarray(getattr(space, "start", np.zeros_like(space.nvec)))
            return _choices(tuple(space.shape), space.nvec.ravel(), start.ravel(), space.dtype)
        case "MultiBinary":
            count = prod(space.shape)
            return _choices(tuple(space.shape), np.full(count, 2), np.zeros(count), space.dtype)
    return None


def _choices(shape: tuple[int, ...], counts: Any, start: Any, dtype: Any) -> Part:
    low = np.asarray(start, np.float64)
    return Part(shape, low, low + counts - 1, dtype, np.asarray(counts, np.int64))
