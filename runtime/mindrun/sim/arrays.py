"""Named arrays that compiled code sees through one pointer: to a block of words, an address and a shape for each."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from functools import cache
from math import prod
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

WORD_BYTES = 8
LINE_BYTES = 64  # of a cache
ADDRESS = "address and words"  # where a block keeps them
Count = int | str  # of rows or columns: a number, or what they are of, by its name


@dataclass(frozen=True, slots=True)
class Room:
    """What an array holds, how many dimensions it has, and its shape: of counts by name, and the number of lanes."""

    dtype: np.dtype[Any]
    dimensions: int
    shape: Callable[[Mapping[str, int], int], tuple[int, ...]]

    def empty(self, counts: Mapping[str, int], lanes: int) -> NDArray[Any]:
        """Zeros for so many lanes, from the beginning of a cache line on: no vector of a row lies in two."""
        shape = self.shape(counts, lanes)
        size = prod(shape) * self.dtype.itemsize
        room = np.zeros(size + LINE_BYTES, np.uint8)
        begin = -room.ctypes.data % LINE_BYTES
        return room[begin : begin + size].view(self.dtype).reshape(shape)

    def holds(self, value: Any) -> bool:
        """True for an array as this one says."""
        is_known = isinstance(value, np.ndarray) and value.dtype == self.dtype and value.ndim == self.dimensions
        return is_known and value.flags.c_contiguous and value.flags.aligned

    @property
    def words(self) -> int:
        """The number of words in a block: an address and a shape."""
        return 1 + self.dimensions


@dataclass(frozen=True)
class Block:
    """Arrays, and blocks of such, by name.

    A kind of block is a frozen dataclass whose fields are `Annotated[Array, Room]` or other kinds of blocks. No array
    of one may be exchanged: `dataclasses.replace` makes another.
    """

    @classmethod
    @cache
    def layout(cls) -> Mapping[str, "tuple[int, Room | type[Block]]"]:
        """The word at which each field begins, and what it is."""
        found: dict[str, tuple[int, Room | type[Block]]] = {}
        place = 0
        for field in fields(cls):
            kind: Any = field.type if isinstance(field.type, type) else get_args(field.type)[1]
            found[field.name] = place, kind
            place += kind.words if isinstance(kind, Room) else kind.length()
        return found

    @classmethod
    @cache
    def length(cls) -> int:
        """The number of its words."""
        return sum(kind.words if isinstance(kind, Room) else kind.length() for _, kind in cls.layout().values())

    @property
    def address(self) -> int:
        """The place of its words, which compiled code is handed; valid as long as this object.

        TypeError where an array is not what its field says: compiled code would write elsewhere.
        """
        if (found := vars(self).get(ADDRESS)) is None:
            words = np.array([*self._words()], np.uint64)
            found = vars(self).setdefault(ADDRESS, (int(words.ctypes.data), words))  # the first of several threads
        return int(found[0])

    def __getstate__(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}  # a copy has words of its own

    def _words(self) -> Iterator[int]:
        for name, (_, kind) in self.layout().items():
            value = getattr(self, name)
            if not isinstance(kind, Room) and isinstance(value, kind):
                yield from value._words()
            elif isinstance(kind, Room) and kind.holds(value):
                yield value.ctypes.data
                yield from value.shape
            else:
                said = f"{kind.dtype} in {kind.dimensions} dimensions" if isinstance(kind, Room) else kind.__name__
                raise TypeError(f"{type(self).__name__}.{name} is not {said}, side by side in the order of C")
