"""Which column of a row is what: two blocks, doubles and singles, each of groups side by side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

DOUBLE_BLOCK, SINGLE_BLOCK = 0, 1  # blocks
FLOW = "flow"  # the last group of singles: it is not kept, but computed for the rows that are asked for


@dataclass(frozen=True, slots=True)
class Group:
    """Columns side by side: `count` of them from `first` on in a block."""

    block: int
    first: int
    count: int

    def column(self, number: int) -> list[int]:
        """The address of one of its columns."""
        return [self.block, self.first + number]


@dataclass(frozen=True, slots=True)
class Columns:
    """The groups of a row by their names."""

    groups: Mapping[str, Group]

    @classmethod
    def of(cls, doubles: Mapping[str, int], singles: Mapping[str, int]) -> Columns:
        """Groups of so many columns each, in this order; `flow`, where there is one, is the last of the singles."""
        groups: dict[str, Group] = {}
        for block, counts in ((DOUBLE_BLOCK, doubles), (SINGLE_BLOCK, singles)):
            first = 0
            for name, count in counts.items():
                groups[name] = Group(block, first, count)
                first += count
        return cls(groups)

    def __getitem__(self, name: str) -> Group:
        return self.groups[name]

    def width(self, block: int) -> int:
        """How many columns a block has."""
        return sum(group.count for group in self.groups.values() if group.block == block)

    @property
    def kept_singles(self) -> int:
        """How many columns of the singles are kept."""
        return self.width(SINGLE_BLOCK) - (self.groups[FLOW].count if FLOW in self.groups else 0)
