"""The known word that somebody meant who wrote another one."""

from collections.abc import Iterable
from difflib import get_close_matches

LEAST_ALIKE = 0.6  # difflib's ratio, below which nothing is looked at closer
LETTERS_PER_MISTAKE = 3
LEAST_PART = 3  # letters of one that the other begins or ends with, or of a word that both have
MAX_LETTERS = 100


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most similar; None where none is near enough to be meant.

    It has one letter wrong, missing, too much or exchanged with the next, or one in three behind the same first letter,
    or both have a part in common.
    """
    by_lower, written = {name.lower(): name for name in known}, word.lower()[:MAX_LETTERS]
    near = get_close_matches(written, by_lower, n=3, cutoff=LEAST_ALIKE)
    return next((by_lower[each] for each in near if _is_meant(written, each[:MAX_LETTERS])), None)


def _is_meant(one: str, other: str) -> bool:
    short, long = sorted((one, other), key=len)
    if len(short) >= LEAST_PART and (long.startswith(short) or long.endswith(short)):
        return True
    if any(len(each) >= LEAST_PART for each in {*one.split("_")} & {*other.split("_")}):
        return True
    mistakes = _mistakes(one, other)
    return mistakes <= 1 or (one[:1] == other[:1] and mistakes <= len(long) // LETTERS_PER_MISTAKE)


def _mistakes(one: str, other: str) -> int:
    """How many letters are wrong, missing, too much or exchanged with the next (optimal string alignment)."""
    rows: list[list[int]] = [[*range(len(other) + 1)]]
    for i, letter in enumerate(one, 1):
        row = [i]
        for k, its in enumerate(other, 1):
            least = min(rows[-1][k] + 1, row[-1] + 1, rows[-1][k - 1] + (letter != its))
            if i > 1 and k > 1 and letter == other[k - 2] and one[i - 2] == its:
                least = min(least, rows[-2][k - 2] + 1)
            row.append(least)
        rows.append(row)
    return rows[-1][-1]
