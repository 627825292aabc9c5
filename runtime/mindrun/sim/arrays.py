"""Named arrays that compiled code sees through one pointer: to a block of words, an address and a shape for each."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from math import prod
from typing import Any

import numpy as np

from mindrun.numbers.arithmetic import LANES
from mindrun.numbers.arrays import Array

WORD_BYTES = 8
LINE_BYTES = 64  # of a cache
ADDRESS = "address and words"  # where a block keeps them
Shape = Callable[[Mapping[Any, int], int], tuple[int, ...]]  # of counts by name, and the number of lanes
Count = Any  # of rows or columns: a number, or what they are of, by its name


@dataclass(frozen=True, slots=True)
class Room:
    """What an array holds, how many dimensions it has, and its shape."""

    dtype: np.dtype[Any]
    dimensions: int
    shape: Shape

    def empty(self, counts: Mapping[str, int], lanes: int) -> Array:
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


def array(kind: Any, dimensions: int, shape: Shape) -> Any:
    """The field of a block that is an array."""
    return field(metadata={Room: Room(np.dtype(kind), dimensions, shape)})


def rows(count: Count, times: int = 1, kind: Any = np.float64) -> Any:
    """An array [row, lane] of at least one row, in whole vectors of lanes: networks compute sixteen at a time."""
    return array(kind, 2, lambda n, lanes: (max(1, times * n.get(count, count)), whole_vectors(lanes)))


def columns(count: Count, times: int = 1, kind: Any = np.float64) -> Any:
    """An array [lane, column]."""
    return array(kind, 2, lambda n, lanes: (lanes, times * n.get(count, count)))


def each(kind: Any = np.int64) -> Any:
    """An array [lane]."""
    return array(kind, 1, lambda n, lanes: (lanes,))


def shape(*counts: Count, kind: Any = np.int64) -> Any:
    """An array that no lane has for itself."""
    return array(kind, len(counts), lambda n, lanes: tuple(n.get(count, count) for count in counts))


def whole_vectors(lanes: int) -> int:
    """A number of lanes, rounded up to whole vectors."""
    return -(-lanes // LANES) * LANES


def table(dtype: Any, dimensions: int = 1) -> Any:
    """An array whose shape follows from the mind and its task."""
    return shape(*[0] * dimensions, kind=dtype)


@dataclass(frozen=True)
class Block:
    """Arrays, and blocks of such, by name.

    A kind of block is a frozen dataclass whose fields are each an `array`, or other kinds of blocks. No array
    of one may be exchanged: `dataclasses.replace` makes another.
    """

    @classmethod
    @cache
    def layout(cls) -> Mapping[str, "tuple[int, Room | type[Block]]"]:
        """The word at which each field begins, and what it is."""
        found: dict[str, tuple[int, Room | type[Block]]] = {}
        place = 0
        for each in fields(cls):
            kind: Any = each.metadata.get(Room, each.type)
            found[each.name] = place, kind
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
        return {each.name: getattr(self, each.name) for each in fields(self)}  # a copy has words of its own

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
