"""`mindrun.arithmetic`, compiled; and what kinds say in its terms."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

from mindrun import arithmetic
from mindrun.arithmetic import HALF as HALF
from mindrun.arithmetic import ONE as ONE
from mindrun.arithmetic import ZERO as ZERO
from mindrun.arithmetic import F as F
from mindrun.sim.compiling import compiled, inlined

bearing, clamp = inlined(arithmetic.bearing), inlined(arithmetic.clamp)
finite, sine_cosine = inlined(arithmetic.finite), inlined(arithmetic.sine_cosine)
in_claw, inside = compiled(arithmetic.in_claw), compiled(arithmetic.inside)
_COMPILED: dict[Callable[..., Any], Callable[..., Any]] = {
    arithmetic.bearing: bearing,
    arithmetic.clamp: clamp,
    arithmetic.finite: finite,
    arithmetic.sine_cosine: sine_cosine,
    arithmetic.in_claw: in_claw,
    arithmetic.inside: inside,
}


def compiled_lane(function: Any) -> Callable[..., Any]:
    """The lane function of a kind, which calls the compiled ones of those that it names."""
    names = {name: function.__globals__[name] for name in function.__code__.co_names if name in function.__globals__}
    known = {name: _COMPILED.get(value, value) if callable(value) else value for name, value in names.items()}
    plain = FunctionType(function.__code__, known, function.__name__)
    plain.__module__, plain.__qualname__ = function.__module__, function.__qualname__
    return compiled(plain)
