"""Why a command was what it was: what each path of influence from the master down has contributed, exactly.

    flows = setup.flows(run)  # of a RecordedRun, or of Ticks
    found = shares(flows, sink_named(flows, "left_wheel"), range(811, 812))  # rows from 0: tick 812 of a simulation

A command is a mean that influence weighs, command = Σ I·v / Σ I (Eq. 3), where the influence I of a skill is a sum over
its parents of what they have sent it (Eq. 2). So each path has a `part` of Σ I, which is the influence that came along
it, and the `share` of the command that this part makes with the value v that the last skill of the path sent. Shares
add up to the command, parts to 1.
"""

from bisect import insort
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count
from math import fsum
from operator import attrgetter

import numpy as np
from mindrun.errors import MindError
from mindrun.numbers.arithmetic import clamp
from mindrun.numbers.arrays import Bools, Doubles
from numpy.typing import NDArray

from mindlang.run.edge_flow import NOTHING, EdgeFlow, EdgeFlows, Sink, accumulated

NAMED_PATHS = 10
MAX_COUNTED_PATHS = 10**15
Linked = tuple[()] | tuple[int, "Linked"]  # edges from an upper one down
# Of a path that is known: minus the bound of its part, a number, its edges, the upper skill, a part and what of it.
End = tuple[float, int, Linked, int, Doubles, Doubles]
MAX_FOLLOWED_EDGES = 200_000  # after which the largest so far are the answer


@dataclass(frozen=True, slots=True)
class Contribution:
    """The contribution of one path, in the mean over the ticks.

    `path` are names, from the master to what is asked about; `value` (0..1) is what its last skill sent, `influence`
    what came along it to that skill, `part` (0..1) its part of all influence, `share` its part of the command.
    """

    path: tuple[str, ...]
    value: float
    influence: float
    part: float
    share: float


@dataclass(frozen=True, slots=True)
class RemainingPaths:
    """The `paths` that are not named, together; 10^15 stands for more, too.

    Over several ticks some of them may have carried nothing.
    """

    paths: int
    part: float
    share: float


@dataclass(frozen=True, slots=True)
class Shares:
    """The command to an actuator or a memory, or the influence on a skill, by paths; means over `ticks` rows.

    command = Σ `share` of `paths` + `rest.share` + `neutral` + `rounding`: `command` is what the mind said, to the bit;
    `neutral` is what an actuator has of it from the `undriven` rows, in which nothing influenced it, and `rounding`
    what the engine's sums in float32 have added. A memory that nothing drives is sent nothing: its means are over the
    other rows, and its `command` is None where there is none; neither it nor a skill has a `neutral`. For a skill
    `command` and `influence` are both its influence, and a share is the influence that came over that path.
    `silent` are the skills that could have sent something and did not.
    Unless they `are_largest`, a path may be among the `rest` that is larger than those named.
    """

    target: Sink
    ticks: int
    command: float | None
    influence: float
    undriven: int
    neutral: float | None
    rounding: float
    paths: tuple[Contribution, ...]
    rest: RemainingPaths
    silent: tuple[int, ...]
    are_largest: bool


def shares(flows: EdgeFlows, target: Sink, rows: range, paths: int = NAMED_PATHS) -> Shares:
    """The shares in the command to `target`, or the influence on it, in one row or more, with the `paths` largest.

    IndexError where a row is not there, MindError where influence that comes to the target was replaced.
    It takes as long as thinking these rows does, and for so many paths as long as they are, however many there are in
    all.
    """
    carried, order = flows.flow_at(rows), _above(flows, target)
    _refuse_replaced(flows, carried, [*order, *([target[1]] if target[0] == "skill" else [])])
    carried = flows.counted_for(target, carried)
    if target == ("skill", flows.skills[0]):
        return _master_shares(flows, len(rows))
    ends = _ends(flows, target, carried)
    into = {skill: _into(flows, skill, carried) for skill in order[1:]}
    found, are_largest = largest_paths(ends, into, order, paths)
    contributions = (_contribution(flows, ends, path) for path in found)
    named = tuple(sorted(contributions, key=attrgetter("part", "share"), reverse=True))
    neutral = _neutral(flows, ends)
    command = ends.mean(ends.engine) + (neutral or 0.0) if ends.ticks else None
    every, part = ends.mean(ends.shares.sum(axis=0)), ends.mean(ends.fractions.sum(axis=0))
    count = path_count(ends, into, order)
    rest = RemainingPaths(
        count - len(named) * (count < MAX_COUNTED_PATHS),
        max(0.0, part - fsum(each.part for each in named)),
        max(0.0, every - fsum(each.share for each in named)),
    )
    return Shares(
        target,
        len(rows),
        command,
        ends.mean(ends.total),
        int((~ends.driven).sum()),
        neutral,
        0.0 if command is None else command - (neutral or 0.0) - every,
        named,
        rest,
        tuple(np.array(ends.sources, int)[~ends.behind.any(axis=1)].tolist()),
        are_largest,
    )


def _master_shares(flows: EdgeFlows, ticks: int) -> Shares:
    """The shares in the influence of the master, which is 1 by definition."""
    path = Contribution((flows.master,), 1.0, 1.0, 1.0, 1.0)
    rest = RemainingPaths(0, 0.0, 0.0)
    return Shares(("skill", flows.skills[0]), ticks, 1.0, 1.0, 0, None, 0.0, (path,), rest, (), True)


@dataclass(frozen=True, slots=True)
class IncomingEdges:
    """The edges [n] over which influence comes to a skill, from the skills `sources` [n].

    `fractions` [n, ticks] are the parts of its influence that come over each, which add up to 1 in each tick in which
    it has any.
    """

    edges: tuple[int, ...]
    sources: tuple[int, ...]
    fractions: Doubles


@dataclass(frozen=True, slots=True)
class FoundPath:
    """A path by its edges, from the master down, its part [ticks] of what is asked about, and the sum of that."""

    edges: tuple[int, ...]
    part: Doubles
    size: float


@dataclass(frozen=True, slots=True)
class _Ends(IncomingEdges):
    """The edges to what is asked about, and what they carry [edges, ticks]; `total`, `engine`, `driven` are [ticks].

    `engine` is what the engine computes of it in float32, where it is driven. Means are over so many `ticks`: of a
    memory those in which it is driven.
    """

    target: Sink
    values: Doubles
    behind: Doubles
    shares: Doubles
    total: Doubles
    engine: Doubles
    driven: Bools

    @property
    def ticks(self) -> int:
        """The number of ticks that means are over."""
        return int(self.driven.sum()) if self.target[0] == "memory" else len(self.driven)

    def mean(self, values: NDArray[np.generic]) -> float:
        """The mean of values [ticks], which are 0 where nothing came."""
        return fsum(values.tolist()) / max(1, self.ticks)


def _refuse_replaced(flows: EdgeFlows, flow: EdgeFlow, skills: Sequence[int]) -> None:
    """MindError where a skill has other influence than all above it have sent, and the master 1."""
    for skill in skills:
        sent = accumulated(flow.carried[:, flows.links_to.get(("skill", skill), [])])
        expected = np.ones_like(sent) if skill == flows.skills[0] else sent
        if not np.array_equal(expected, flow.influence[:, skill], equal_nan=True):
            name = flows.graph.skills[skill].name
            raise MindError(
                f"the influence of {name} was replaced: nobody sent it", "Ask about the run as it is without that."
            )


def _ends(flows: EdgeFlows, target: Sink, carried: EdgeFlow) -> _Ends:
    edges = tuple(flows.links_to.get(target, ()))
    values, behind, product = (of[:, edges].T.astype(float) for of in (carried.value, carried.behind, carried.carried))
    is_skill = target[0] == "skill"
    weight = product if is_skill else behind
    with np.errstate(all="ignore"):
        sums = [accumulated(each.T) for each in (product, weight)]
        engine = sums[0] if is_skill else sums[0] / sums[1]
        driven = (sums[1] > 0) & np.isfinite(engine)
        total = np.where(driven, weight.sum(axis=0), 0.0)
        parts = np.where(driven, weight / total, 0.0)
        gain = np.where(driven, product / (1.0 if is_skill else total), 0.0)
    commands = np.array([value if is_skill else clamp(value) for value in np.where(driven, engine, NOTHING)], float)
    sources = tuple(flows.links[edge].source for edge in edges)
    return _Ends(edges, sources, parts, target, values, behind, gain, total, commands, driven)


def _neutral(flows: EdgeFlows, ends: _Ends) -> float | None:
    kind, index = ends.target
    if kind != "actuator":
        return None
    return float(np.float32(flows.graph.actuators[index].kind.neutral)) * ends.mean(~ends.driven)


def _contribution(flows: EdgeFlows, ends: _Ends, path: FoundPath) -> Contribution:
    """A path in the mean over the ticks; its value where it has a part, weighed by that, or in all if it has none."""
    place = ends.edges.index(path.edges[-1])
    sources = [flows.links[edge].source for edge in path.edges]
    names = [flows.graph.skills[source].name for source in sources] + [flows.graph.named(*ends.target)]
    with np.errstate(all="ignore"):
        along = np.where(ends.fractions[place] > 0, path.part / ends.fractions[place], 0.0)
    sent = ends.values[place]
    value = sent[0] if (sent == sent[0]).all() else np.average(sent, weights=path.part if path.part.any() else None)
    influence, share = ends.mean(along * ends.behind[place]), ends.mean(along * ends.shares[place])
    return Contribution(tuple(names), float(value), influence, ends.mean(path.part), share)


def _above(flows: EdgeFlows, target: Sink) -> list[int]:
    """The master, and all skills over which influence comes to the target, parents first."""
    found, wanted = {flows.skills[0]}, {target}
    for link in reversed(flows.links):
        if link.target in wanted:
            found.add(link.source)
            wanted.add(("skill", link.source))
    return [skill for skill in flows.skills if skill in found]


def _into(flows: EdgeFlows, skill: int, carried: EdgeFlow) -> IncomingEdges:
    edges = tuple(flows.links_to["skill", skill])
    arrived = carried.carried[:, edges].T.astype(float)
    # influence beyond float32 is no number: where some of it is none, that is all of it
    arrived = np.where(np.isfinite(arrived).all(axis=0), arrived, ~np.isfinite(arrived))
    total = arrived.sum(axis=0)
    fractions = np.divide(arrived, total, out=np.zeros_like(arrived), where=total > 0)
    return IncomingEdges(edges, tuple(flows.links[edge].source for edge in edges), fractions)


def largest_paths(
    ends: IncomingEdges, into: Mapping[int, IncomingEdges], order: Sequence[int], limit: int
) -> tuple[list[FoundPath], bool]:
    """The paths whose parts, summed over the ticks, are largest, and False where the search was given up before.

    `ends` are the edges to what is asked about, with the part that comes over each; `into` has the ways into each
    skill, `order` the skills parents first, the master before all. A path's end can at most come to its part times that
    of the best path above it in each tick. The end of which this sum is largest is followed up, always over its best
    way, until no end is left that could be larger than what is found. In one tick nothing is followed in vain.
    """
    ticks = ends.fractions.shape[1]
    best, number = _best(into, order, ticks), count()
    followed, found = 0, list[FoundPath]()

    def onward(ways: IncomingEdges, part: Doubles, edges: Linked) -> list[End]:
        """A path's end with this part, longer by each of the ways on, the best first."""
        above = _part_above(ways, best)
        bounds = above @ part
        return sorted(
            (-float(bounds[i]), next(number), (ways.edges[i], edges), ways.sources[i], part, ways.fractions[i])
            for i in np.flatnonzero(above.any(axis=1))
        )

    waiting = onward(ends, np.ones(ticks), ())  # sorted, so a heap
    while waiting and not (len(found) >= limit and found[limit - 1].size >= -waiting[0][0]):
        if followed > MAX_FOLLOWED_EDGES:
            return found, False
        _, _, edges, skill, part, fraction = heappop(waiting)
        while True:
            part = part * fraction
            followed += 1
            if skill not in into:
                break
            (_, _, edges, skill, _, fraction), *others = onward(into[skill], part, edges)
            for other in others:
                heappush(waiting, other)
        insort(found, FoundPath(tuple(_unlinked(edges)), part, float(part.sum())), key=lambda path: -path.size)
        del found[limit:]
    return found, True


def path_count(ends: IncomingEdges, into: Mapping[int, IncomingEdges], order: Sequence[int]) -> int:
    """How many paths there are over edges that carried something in any of the ticks, up to `MAX_COUNTED_PATHS`."""
    counts: dict[int, int] = {order[0]: 1}
    for skill in order[1:]:
        counts[skill] = _counted(into[skill], counts)
    return _counted(ends, counts)


def _counted(ways: IncomingEdges, counts: Mapping[int, int]) -> int:
    used = np.flatnonzero(ways.fractions.any(axis=1))
    return min(MAX_COUNTED_PATHS, sum(counts[ways.sources[number]] for number in used))


def _best(into: Mapping[int, IncomingEdges], order: Sequence[int], ticks: int) -> dict[int, Doubles]:
    """The part [ticks] of each skill's influence that comes over the best path to it in that tick."""
    best = {order[0]: np.ones(ticks)}
    for skill in order[1:]:
        best[skill] = _part_above(into[skill], best).max(axis=0)
    return best


def _part_above(ways: IncomingEdges, best: Mapping[int, Doubles]) -> Doubles:
    """The part [n, ticks] that comes at most over a path by each of the ways."""
    above: Doubles = np.reshape([best[source] for source in ways.sources], ways.fractions.shape)
    return ways.fractions * above


def _unlinked(edges: Linked) -> Iterator[int]:
    while edges:
        edge, edges = edges
        yield edge
