"""The search for runs that fail: on many layouts, then where the numbers of a task lie as in the worst of these.

By the cross-entropy method (Rubinstein, 1999): in each round the runs are chosen about the worst tenth of the round
before, by a normal distribution of each number. Nothing but seeds is chosen, so that each run can be made again.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
from mindrun.graph.run_scores import Scores
from mindrun.sim.rollout import Rollout
from numpy.typing import NDArray

from mindlang.falsify.failures import Criterion, Mask, Rate
from mindlang.falsify.numbers import Number, drawn_at
from mindlang.falsify.region import TIMES_WORSE, Box, Doubles, Tried, worst_box
from mindlang.run.setup import layouts, run_all

MAX_ROUNDS = 20
ELITE_SHARE = 0.1  # of a round, about which the runs of the next are chosen
MIN_SPREAD_SHARE = 0.02  # of what a number can be: no narrower are runs chosen
ROUND_BOUNDS = 50, 1000  # runs of a round, else a twentieth of those on any layouts
CHECKED_BOUNDS = 50, 1000  # runs that try a region, else a tenth of those on any layouts
NO_SPREAD = 1e-12  # of a number that is the same in every run
POOL_RUNS = 100_000  # of which the beginning is computed, to choose from
SLICE_RUNS = 256  # between two looks at the clock
UNIFORM_SHARE, SEARCHED_SHARE = 0.5, 0.9  # of the seconds, after which a stage ends

Ran = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class Runs:
    """Runs that have been made: their `places` [runs] among the layouts of the seed, from 1, their scores and numbers.

    `drawn` is [runs, numbers].
    """

    places: NDArray[np.int64]
    seeds: NDArray[np.uint64]
    scores: Scores
    drawn: Doubles

    def and_those(self, others: Sequence["Runs"]) -> "Runs":
        """These runs, then others."""
        every = [self, *others]
        joined = (np.concatenate([getattr(each.scores, of.name) for each in every], axis=1) for of in fields(Scores))
        names = "places", "seeds", "drawn"
        places, seeds, drawn = (np.concatenate([getattr(each, name) for each in every]) for name in names)
        return Runs(places, seeds, Scores(*joined), drawn)


@dataclass(frozen=True, slots=True)
class Region:
    """A box of numbers, the failures of fresh runs in it, and the share of all layouts that it holds."""

    box: Box
    rate: Rate
    share: float


@dataclass(frozen=True)
class Found:
    """The runs on any layouts, those of the rounds of a search, and those that tried the region that it came to.

    The `region` fails at least twice as often as any layouts; else there is none.
    """

    criterion: Criterion
    numbers: Sequence[Number]
    uniform: Runs
    rounds: Sequence[Runs]
    checked: Sequence[Runs]
    region: Region | None

    @property
    def rate(self) -> Rate:
        """The failures on any layouts."""
        return Rate.of(int(self.criterion.failed(self.uniform.scores).sum()), len(self.uniform.places))

    @cached_property
    def runs(self) -> Runs:
        """All runs in the order in which they were made."""
        return self.uniform.and_those([*self.rounds, *self.checked])


@dataclass(frozen=True, slots=True)
class Search:
    """A task under a master in a simulator, what is a failure in it, the numbers that it draws, and the layouts' seed.

    `passed` is the share of the time that has passed, always 0 where runs are counted instead.
    """

    rollout: Rollout
    criterion: Criterion
    numbers: Sequence[Number]
    seed: int
    ran: Ran = lambda runs: None
    passed: Callable[[], float] = lambda: 0.0

    def find(self, runs: int | None) -> Found:
        """What many runs on any layouts find, or of None those of half of the time, and then a search."""
        uniform = self._uniform(runs)
        criterion = self.criterion.with_default(uniform.scores)
        if not self.numbers or self.rollout.is_one_world:
            return Found(criterion, self.numbers, uniform, (), (), None)
        pool = _Pool(self, len(uniform.places))
        aims, rounds = self._rounds(criterion, uniform, pool)
        done, sizes = uniform.and_those(rounds), [len(each.places) for each in rounds]
        shares = [aim.share(done.drawn) / aim.share(pool.drawn).mean() for aim in aims]
        likely = len(uniform.places) + sum(size * each for size, each in zip(sizes, shares, strict=True))
        tried = Tried(done.drawn, criterion.failed(done.scores), 1 / (likely * np.ones(len(done.places))))
        box = worst_box(self._whole, tried)
        found = Found(criterion, self.numbers, uniform, rounds, (), None)
        return self._checked(found, box) if box else found

    def run(self, places: NDArray[np.int64], seeds: NDArray[np.uint64], drawn: Doubles | None = None) -> Runs:
        """The runs of these seeds."""
        said = seeds.tolist()
        if drawn is None:
            drawn = drawn_at(self.rollout, said) if self.numbers else np.empty((len(said), 0))
        return Runs(places, seeds, run_all(self.rollout, said, self.ran), drawn)

    def layouts(self, first: int, count: int) -> tuple[NDArray[np.int64], NDArray[np.uint64]]:
        """The places from `first` on, counted from 0, and their seeds."""
        count = 1 if self.rollout.is_one_world else count
        return np.arange(first + 1, first + count + 1), np.array(layouts(self.seed, first + count)[first:], np.uint64)

    def _uniform(self, runs: int | None) -> Runs:
        if runs is not None:
            return self.run(*self.layouts(0, runs))
        until = UNIFORM_SHARE if self.numbers else 1.0
        made = [self.run(*self.layouts(0, SLICE_RUNS))]
        while self.passed() < until and not self.rollout.is_one_world:
            made.append(self.run(*self.layouts(len(made) * SLICE_RUNS, SLICE_RUNS)))
        return made[0].and_those(made[1:])

    @property
    def _whole(self) -> Box:
        """All that the numbers can be."""
        return Box(*(np.array([getattr(each, side) for each in self.numbers], float) for side in ("low", "high")))

    def _rounds(self, criterion: Criterion, uniform: Runs, pool: "_Pool") -> tuple[list["_Aim"], list[Runs]]:
        """The rounds of the cross-entropy method, each about the worst of the one before, with what each aimed at."""
        whole, aims, made = self._whole, list[_Aim](), [uniform]
        aim = _Aim((whole.low + whole.high) / 2, np.full(len(whole.low), np.inf))
        for number in range(MAX_ROUNDS):
            if (elite := _elite(criterion, made[-1])) is not None:
                least = MIN_SPREAD_SHARE * (whole.high - whole.low)
                aim = _Aim(elite.mean(axis=0), np.maximum(elite.std(axis=0), np.maximum(least, NO_SPREAD)))
            chosen = pool.chosen(aim.log_share(pool.drawn), round_runs(len(uniform.places)), number)
            if not len(chosen) or self.passed() > SEARCHED_SHARE:
                break
            aims.append(aim)
            made.append(pool.run(chosen))
        return aims, made[1:]

    def _checked(self, found: Found, box: Box) -> Found:
        """The search with a region, if fresh runs in it fail at least twice as often as on any layouts."""
        pool = _Pool(self, len(found.uniform.places) + POOL_RUNS)
        held = box.holds(pool.drawn)
        fresh = pool.run(np.flatnonzero(held)[: checked_runs(len(found.uniform.places))])
        rate = Rate.of(int(found.criterion.failed(fresh.scores).sum()), len(fresh.places))
        is_worse = rate.failures > 0 and rate.share >= TIMES_WORSE * found.rate.share
        region = Region(box, rate, float(held.mean())) if is_worse else None
        return replace(found, checked=[fresh], region=region)


@dataclass(frozen=True, slots=True)
class _Aim:
    """A normal distribution of each number, without what would make it one: its `middle` and its `spread` [numbers]."""

    middle: Doubles
    spread: Doubles

    def log_share(self, drawn: Doubles) -> Doubles:
        """The logarithm [runs] of how likely runs with these numbers [runs, numbers] are chosen, 0 in the middle."""
        return np.asarray(-0.5 * (((drawn - self.middle) / self.spread) ** 2).sum(axis=1))

    def share(self, drawn: Doubles) -> Doubles:
        return np.exp(self.log_share(drawn))


class _Pool:
    """Runs that may be made, of which nothing but the numbers is known, behind so many that have been made."""

    def __init__(self, search: Search, first: int) -> None:
        self._search = search
        self._places, self._seeds = search.layouts(first, POOL_RUNS)
        self.drawn = drawn_at(search.rollout, self._seeds.tolist())
        self.is_free: Mask = np.ones(len(self._places), np.bool_)

    def chosen(self, log_weights: Doubles, count: int, number: int) -> NDArray[np.intp]:
        """Places of free runs, `count` at most, drawn by weight: the least exponential numbers over it (Efraimidis)."""
        rng = np.random.default_rng(np.random.SeedSequence(self._search.seed, spawn_key=(number,)))
        keys = np.log(rng.standard_exponential(len(log_weights))) - log_weights
        free = np.flatnonzero(self.is_free)
        return np.sort(free[np.argsort(keys[free], kind="stable")[:count]])

    def run(self, chosen: NDArray[np.intp]) -> Runs:
        """The runs that were chosen, which are free no more."""
        self.is_free[chosen] = False
        return self._search.run(self._places[chosen], self._seeds[chosen], self.drawn[chosen])


def round_runs(uniform: int) -> int:
    """The runs of a round after so many on any layouts."""
    return min(max(uniform // MAX_ROUNDS, ROUND_BOUNDS[0]), ROUND_BOUNDS[1])


def checked_runs(uniform: int) -> int:
    """The runs at most that try a region after so many on any layouts."""
    return min(max(uniform // 10, CHECKED_BOUNDS[0]), CHECKED_BOUNDS[1])


def _elite(criterion: Criterion, runs: Runs) -> Doubles | None:
    """The numbers [runs, numbers] of the worst tenth of some runs; None where those in the middle are as bad."""
    order, failed = criterion.worst_first(runs.scores), criterion.failed(runs.scores)
    last, middle = max(2, round(ELITE_SHARE * len(order))) - 1, len(order) // 2
    of = [(failed[each], runs.scores.counts[0, each], runs.scores.total[0, each]) for each in order[[last, middle]]]
    return None if of[0] == of[1] else runs.drawn[order[: last + 1]]
