"""Work counted in calls of functions, Python's and C's: the same number on any machine, however busy it is."""

import sys
from contextlib import AbstractContextManager, nullcontext
from types import TracebackType
from typing import Self


class CallCount:
    """How many functions are called within a `with` in this thread: `number`.

    A call beyond `most` is an AssertionError where it is made, so that what has no end ends; and again at the end of
    the block, should the program have caught it.
    """

    def __init__(self, most: float = float("inf")) -> None:
        self.most, self.number = most, 0

    def __enter__(self) -> Self:
        sys.setprofile(self._profile)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        sys.setprofile(None)
        if kind is None:
            self._hold()

    def _profile(self, _: object, event: str, __: object) -> None:
        if event in ("call", "c_call"):
            self.number += 1
            if self.number > self.most:
                self._hold()

    def _hold(self) -> None:
        assert self.number <= self.most, f"{self.number:,} calls of functions, more than {self.most:,}"


def one_in_eight(number: int, most: float) -> AbstractContextManager[object]:
    """A CallCount for every eighth of many cases: to count takes twice as long as what is counted."""
    return nullcontext() if number % 8 else CallCount(most)
