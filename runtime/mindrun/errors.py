"""Errors about what a mind is given, each with one sentence for the user, and the name that was meant by another."""

import errno
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

OUR_OWN = ("mindlang", "mindrun")
LEAST_ALIKE = 0.6  # difflib's ratio, below which nothing is looked at closer
LETTERS_PER_MISTAKE = 3
LEAST_PART = 3  # letters of one that the other begins or ends with, or of a word that both have
MAX_LETTERS = 100


class MindError(Exception):
    """Something a user gave is wrong: the text says what, and `hint`, where there is one, what to do.

    >>> raise mindrun.MindError("there is no skill called Avoyd", "Did you mean Avoid?")
    Traceback (most recent call last):
    mindrun.errors.MindError: there is no skill called Avoyd
    """

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


class WeightsError(MindError):
    """A skill's weights are missing, not finite, or not as many as its function has."""


class ProcedureError(MindError):
    """A procedure is missing, raised an exception, or returned something that is not one number per output."""


class BundleError(MindError):
    """A bundle, or a graph read from data, is damaged or was made by something else."""


class ReadingsError(MindError):
    """Readings that do not fit the mind's sensors."""


def reason(error: Exception) -> str:
    """Why something cannot be read or written, in the words of the system where those are all there is."""
    if isinstance(error, OSError) and error.errno == errno.EBADF:
        return "it is closed"
    return getattr(error, "strerror", None) or str(error)


@contextmanager
def system_errors_as(kind: type[MindError], message: str, hint: str = "") -> Iterator[None]:
    """Raise an OSError as an error of this kind: the message, and behind it why, in the words of the system."""
    try:
        yield
    except OSError as error:
        raise kind(f"{message}: {error.strerror}", hint) from error


def text_of(error: BaseException) -> str:
    """The text of an error of somebody else's code, in one line; the name of its type where it has none, or fails."""
    try:
        said = " ".join(str(error).split())
    except BaseException:  # it is that code which says it
        said = ""
    return said or type(error).__name__


def surroundings(error: Exception) -> str:
    """A sentence for errors of the machine, of files and of the installation, about which a user can do something."""
    match error:
        case OSError() if error.filename is not None:
            return f"{error.strerror}: {error.filename}"
        case OSError():
            try:
                os.getcwd()  # noqa: PTH109
            except OSError:
                return "the folder in which this was started is gone"
            return reason(error)
        case MemoryError():
            return "there is not enough memory for this" + (f" ({error})" if str(error) else "")
        case RecursionError():
            return "something here is nested too deep"
        case UnicodeError():
            return f"there is text that cannot be read or written in its encoding ({error})"
        case ImportError() if (error.name or "").partition(".")[0] not in OUR_OWN:
            return f"something that is needed is not installed, or cannot be loaded: {error}"
        case RuntimeError() if "thread" in str(error):
            return f"the system gives no more threads ({error})"
    return ""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word that is most similar; None where none is near enough to be meant.

    It has one letter wrong, missing, too much or exchanged with the next, or one in three behind the same first letter,
    or both have a part in common.
    """
    from difflib import get_close_matches

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
