"""Numbers that a task draws for each run, from the seed of the run alone: they move nothing else that is drawn."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product
from math import isfinite, nan, prod

from mindrun.numbers.expression import Program, evaluate, fold, leaves
from mindrun.numbers.intervals import Interval, combined, negated

GOLDEN_STEP, MIX_1, MIX_2 = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB  # SplitMix64
BEFORE_THE_WORLD = 0xA0761D6478BD642F  # what the seed is joined with: the world itself is drawn from the seed
WORD_MASK = (1 << 64) - 1
MAX_VALUES = 1000
MAX_PLACES = 16  # of one thing that are looked at one by one, before it is only the least and the greatest
MAX_CASES = 4096  # of several numbers together
NO_NUMBER: Interval = (nan, nan)


@dataclass(frozen=True, slots=True)
class Draw:
    """A number of a run: one of its values, alike probable, or where it `is_range` any between its two values."""

    name: str
    values: tuple[float, ...]
    is_range: bool = False

    @property
    def interval(self) -> Interval:
        """The least and the greatest that it can be."""
        return min(self.values), max(self.values)

    @property
    def ends(self) -> Sequence[float]:
        """All values, or of a range or very many the least and the greatest; each once."""
        several = self.interval if self.is_range or len(self.values) > MAX_PLACES else self.values
        return [*dict.fromkeys(several)]

    @property
    def is_count(self) -> bool:
        """True if all that it can be are numbers of things."""
        return not self.is_range and all(value >= 0 and value.is_integer() for value in self.values)

    @property
    def cases(self) -> Sequence[Interval]:
        """All that it can be: each of its values, or of a range or very many one interval."""
        is_one = self.is_range or len(self.values) > MAX_PLACES
        return [self.interval] if is_one else [(end, end) for end in self.ends]


def ends_of(programs: Sequence[Program], draws: Sequence[Draw]) -> list[tuple[float, ...]]:
    """The values of programs for the ends of all numbers that they name, each once; of very many cases the first."""
    read = {index for program in programs for index in leaves(program, "drawn")}
    ends = product(*(draw.ends if index in read else draw.values[:1] for index, draw in enumerate(draws)))
    found = (tuple(evaluate(given(program, drawn)) for program in programs) for drawn in islice(ends, MAX_CASES))
    return [*dict.fromkeys(found)]


def given(program: Program, drawn: Sequence[float]) -> Program:
    """A program with its drawn numbers filled in."""
    return tuple(("number", drawn[int(x)]) if word == "drawn" else (word, x) for word, x in program)


def intervals_of(program: Program, draws: Sequence[Draw]) -> Iterator[tuple[Mapping[int, Interval], Interval]]:
    """The numbers that a program names, by their places, in each case; and where its value lies then.

    That is NaN where anything in it may not be finite.
    """
    read = sorted(leaves(program, "drawn"))
    cases = [draws[index].cases for index in read]
    several = cases if prod(map(len, cases)) <= MAX_CASES else [[draws[index].interval] for index in read]
    for case in product(*several):
        known = dict(zip(read, case, strict=True))
        yield known, fold(program, lambda word, x: known[x] if word == "drawn" else (x, x), negated, _finite)  # noqa: B023


def _finite(symbol: str, left: Interval, right: Interval) -> Interval:
    """The interval of an operation, NaN where it or what it is of is not finite."""
    found = combined(symbol, left, right)
    return found if all(map(isfinite, (*left, *right, *found))) else NO_NUMBER


def drawn_numbers(draws: Sequence[Draw], seed: int) -> Mapping[str, float]:
    """The number of each draw in the run of a seed, by its name: the same bits as in the lanes."""
    state, found = seed ^ BEFORE_THE_WORLD, dict[str, float]()
    for draw in draws:
        state = (state + GOLDEN_STEP) & WORD_MASK
        mixed = ((state ^ (state >> 30)) * MIX_1) & WORD_MASK
        mixed = ((mixed ^ (mixed >> 27)) * MIX_2) & WORD_MASK
        share = float((mixed ^ (mixed >> 31)) >> 11) * 2.0**-53
        low, high = (draw.values[0], draw.values[1]) if draw.is_range else (0.0, float(len(draw.values)))
        number = low + (high - low) * share
        found[draw.name] = number if draw.is_range else draw.values[min(int(number), len(draw.values) - 1)]
    return found


def drawn_in_words(drawn: Mapping[str, float]) -> str:
    """The numbers that were drawn for a run, behind its seed: `, side 1, speed 3.5`; empty where there is none."""
    return "".join(f", {name} {number:.6g}" for name, number in drawn.items())
