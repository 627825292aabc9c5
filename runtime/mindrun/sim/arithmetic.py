"""`mindrun.numbers.arithmetic`, compiled; and what kinds say in its terms."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

from mindrun.numbers import arithmetic, stack_machine
from mindrun.numbers.arithmetic import HALF as HALF
from mindrun.numbers.arithmetic import ONE as ONE
from mindrun.numbers.arithmetic import ZERO as ZERO
from mindrun.numbers.arithmetic import F as F
from mindrun.sim import vector
from mindrun.sim.compiling import compiled, inlined

_INLINED = ("bearing", "clamp", "finite", "sine_cosine", "wrapped", "short_way")
_CALLED = ("place_of", "put_thing", "size_of", "distance_of", "box_of")
_VECTORS = ("splat", "broadcast", "load", "store", "sigmoids")
_COMPILED: dict[Any, Callable[..., Any]] = {
    **{getattr(arithmetic, name): inlined(getattr(arithmetic, name)) for name in _INLINED},
    **{getattr(arithmetic, name): compiled(getattr(arithmetic, name)) for name in _CALLED},
    **{getattr(arithmetic, name): getattr(vector, name) for name in _VECTORS},
}


def compiled_lane(function: Any) -> Callable[..., Any]:
    """A function of a kind's module, compiled with those of that module and of `numbers.arithmetic` that it calls."""
    if function not in _COMPILED:
        _COMPILED[function] = compiled(_calling_compiled(function))
    return _COMPILED[function]


def _calling_compiled(function: Any) -> FunctionType:
    """The same function, which calls what is compiled."""
    names = {
        name: compiled_lane(value) if isinstance(value, FunctionType) and value is not function else value
        for name, value in arithmetic.terms(function).items()
    }
    plain = FunctionType(function.__code__, names, function.__name__)
    plain.__module__, plain.__qualname__ = function.__module__, function.__qualname__
    return plain


bearing, clamp, finite, sine_cosine, wrapped, short_way = (_COMPILED[getattr(arithmetic, name)] for name in _INLINED)
place_of, put_thing, size_of, distance_of, box_of = (_COMPILED[getattr(arithmetic, name)] for name in _CALLED)
in_claw, inside = compiled_lane(arithmetic.in_claw), compiled_lane(arithmetic.inside)
nearest = _COMPILED[arithmetic.nearest] = inlined(_calling_compiled(arithmetic.nearest))  # which no call can return
evaluate = compiled_lane(stack_machine.evaluate)
