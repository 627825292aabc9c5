"""Numbers that a task draws for each run, from the seed of the run alone: they move nothing else that is drawn."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

GOLDEN_STEP, MIX_1, MIX_2 = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB  # SplitMix64
BEFORE_THE_WORLD = 0xA0761D6478BD642F  # what the seed is joined with: the world itself is drawn from the seed
WORD_MASK = (1 << 64) - 1
MAX_VALUES = 1000
MAX_PLACES = 16  # of one thing that are looked at one by one, before it is only the least and the greatest


@dataclass(frozen=True, slots=True)
class Draw:
    """A number of a run: one of its values, alike probable, or where it `is_range` any between its two values."""

    name: str
    values: tuple[float, ...]
    is_range: bool = False

    @property
    def interval(self) -> tuple[float, float]:
        """The least and the greatest that it can be."""
        return min(self.values), max(self.values)

    @property
    def ends(self) -> Sequence[float]:
        """All values, or of a range or very many the least and the greatest; each once."""
        several = self.interval if self.is_range or len(self.values) > MAX_PLACES else self.values
        return [*dict.fromkeys(several)]


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
