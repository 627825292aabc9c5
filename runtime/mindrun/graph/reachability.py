"""What can be reached from somewhere: the skills below a skill, the sensors from which a sensor is computed."""

from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

T = TypeVar("T", bound=Hashable)


def reached_from(start: Iterable[T], onward: Callable[[T], Iterable[T]]) -> set[T]:
    """These and all that `onward` leads to from them, step by step; there may be circles."""
    found = set(start)
    waiting = [*found]
    while waiting:
        new = set(onward(waiting.pop())) - found
        found |= new
        waiting += new
    return found
