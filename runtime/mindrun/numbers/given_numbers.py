"""Numbers that a user's code returns: Python's, numpy's, those of any library that can be made a float."""

from collections.abc import Sequence
from numbers import Complex, Real
from typing import Any, SupportsFloat, SupportsIndex

TEXT = str | bytes | bytearray | memoryview
NUMBER_KINDS = "biuf"  # of numpy's types; others are text, times, complex


def number(value: Any) -> float:
    """A number as a float; True is 1.0. TypeError where it is none, as text and lists are; whatever its code raises."""
    if type(value) is float:
        return value
    if (
        isinstance(value, TEXT)
        or (isinstance(value, Complex) and not isinstance(value, Real))
        or getattr(value, "ndim", None)
        or getattr(getattr(value, "dtype", None), "kind", "f") not in NUMBER_KINDS
        or not isinstance(value, SupportsFloat | SupportsIndex)
    ):
        raise TypeError(f"{value!r:.60} is no number")
    return float(value)


def is_truth(value: Any) -> bool:
    """True if a value is a truth value, of Python or of another library."""
    return isinstance(value, bool) or "bool" in str(getattr(value, "dtype", ""))


def values(given: Any) -> list[Any] | None:
    """The items of a list, a tuple, or an array of any shape, one after the other; None of anything else."""
    if getattr(given, "ndim", None) and hasattr(given, "ravel"):
        return [*given.ravel()]
    return [*given] if isinstance(given, Sequence) and not isinstance(given, TEXT) else None
