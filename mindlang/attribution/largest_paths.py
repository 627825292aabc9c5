"""The largest of the paths from a master down, of which a deep hierarchy has too many to look at each."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
MAX_COUNTED_PATHS = 10**15
Linked = tuple[()] | tuple[int, "Linked"]  # edges from an upper one down
MAX_FOLLOWED_EDGES = 200_000  # after which the largest so far are the answer


@dataclass(frozen=True, slots=True)
class Ways:
    """How influence comes to a skill: the edges [n] from the skills `sources` [n].

    `fractions` [n, ticks] are the parts of its influence that come over each, which add up to 1 in each tick in which
    it has any.
    """

    edges: tuple[int, ...]
    sources: tuple[int, ...]
    fractions: Doubles


@dataclass(frozen=True, slots=True)
class FoundPath:
    """A path by its edges, from the master down, and its part [ticks] of what is asked about."""

    edges: tuple[int, ...]
    part: Doubles


@dataclass(frozen=True, slots=True)
class LargestPaths:
    """The largest paths, the largest first. Unless `are_largest`, the search was given up before it was sure of it."""

    paths: list[FoundPath]
    are_largest: bool


@dataclass(frozen=True, slots=True)
class _Beginning:
    """A path's end that is known: its edges as a linked list from the upper one on, its part as a product."""

    edges: Linked
    skill: int
    above: Doubles
    fraction: Doubles


def largest_paths(ends: Ways, into: Mapping[int, Ways], order: Sequence[int], limit: int) -> LargestPaths:
    """The paths whose parts, summed over the ticks, are largest.

    `ends` are the edges to what is asked about, with the part that comes over each; `into` has the ways into each
    skill, `order` the skills parents first, the master before all. A path's end can at most come to its part times that
    of the best path above it in each tick. The end of which this sum is largest is followed up, always over its best
    way, until no end is left that could be larger than what is found. In one tick nothing is followed in vain.
    """
    search = _Search(into, _best(into, order, ends.fractions.shape[1]))
    found: list[tuple[float, int, FoundPath]] = []
    search.push(ends, np.ones(ends.fractions.shape[1]), ())
    while search.waiting:
        if len(found) >= limit and found[limit - 1][0] >= -search.waiting[0][0]:
            break
        if search.followed > MAX_FOLLOWED_EDGES:
            return LargestPaths([path for _, _, path in found[:limit]], are_largest=False)
        path = search.followed_up()
        found.append((float(path.part.sum()), -len(found), path))
        found.sort(key=lambda each: each[:2], reverse=True)
        del found[limit:]
    return LargestPaths([path for _, _, path in found], are_largest=True)


def path_count(ends: Ways, into: Mapping[int, Ways], order: Sequence[int]) -> int:
    """How many paths there are over edges that carried something in any of the ticks, up to `MAX_COUNTED_PATHS`."""
    counts: dict[int, int] = {order[0]: 1}
    for skill in order[1:]:
        counts[skill] = _counted(into[skill], counts) if skill in into else 0
    return _counted(ends, counts)


def _counted(ways: Ways, counts: Mapping[int, int]) -> int:
    used = np.flatnonzero(ways.fractions.any(axis=1))
    return min(MAX_COUNTED_PATHS, sum(counts[ways.sources[number]] for number in used))


def _best(into: Mapping[int, Ways], order: Sequence[int], ticks: int) -> dict[int, Doubles]:
    """The part [ticks] of each skill's influence that comes over the best path to it in that tick."""
    best = {order[0]: np.ones(ticks)}
    for skill in order[1:]:
        ways = into.get(skill)
        best[skill] = np.zeros(ticks) if ways is None else _above(ways, best).max(axis=0)
    return best


def _above(ways: Ways, best: Mapping[int, Doubles]) -> Doubles:
    """The part [n, ticks] that comes at most over a path by each of the ways."""
    above: Doubles = np.reshape([best[source] for source in ways.sources], ways.fractions.shape)
    return ways.fractions * above


class _Search:
    """The ends of paths that are still to be followed up, and how many edges were."""

    def __init__(self, into: Mapping[int, Ways], best: Mapping[int, Doubles]) -> None:
        self.waiting: list[tuple[float, int, _Beginning]] = []
        self.followed = 0
        self._into, self._best, self._number = into, best, count()

    def push(self, ways: Ways, part: Doubles, edges: Linked) -> None:
        """Let an end that has this part wait, once for each of the ways on."""
        for bound, beginning in self._onward(ways, part, edges):
            heappush(self.waiting, (-bound, next(self._number), beginning))

    def followed_up(self) -> FoundPath:
        """The end that comes first, followed to the master; the other ways wait."""
        _, _, here = heappop(self.waiting)
        while True:
            part = here.above * here.fraction
            self.followed += 1
            if here.skill not in self._into:
                return FoundPath(tuple(_unlinked(here.edges)), part)
            ways = sorted(self._onward(self._into[here.skill], part, here.edges), key=lambda way: -way[0])
            for bound, other in ways[1:]:
                heappush(self.waiting, (-bound, next(self._number), other))
            here = ways[0][1]

    def _onward(self, ways: Ways, part: Doubles, edges: Linked) -> Iterator[tuple[float, _Beginning]]:
        above = _above(ways, self._best)
        bounds = above @ part
        for number in np.flatnonzero(above.any(axis=1)):
            edge, source = ways.edges[number], ways.sources[number]
            yield float(bounds[number]), _Beginning((edge, edges), source, part, ways.fractions[number])


def _unlinked(edges: Linked) -> Iterator[int]:
    while edges:
        edge, edges = edges
        yield edge
