"""Lanes of kinds in plain Python: with what they name, and not compiled."""

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from mindrun.sim.dependencies import used


@cache
def plain_lane(function: Any) -> Callable[..., Any]:
    """A function of a kind's file that can be called as it stands."""
    if not isinstance(function, FunctionType) or function.__module__ == "mindrun.numbers.arithmetic":
        return function  # type: ignore[no-any-return]
    found: dict[str, Any] = {"__builtins__": __builtins__}
    made = FunctionType(function.__code__, found, function.__name__)
    for name, value in used(function):
        found[name] = plain_lane(value) if isinstance(value, FunctionType) and value is not function else value
    return made
