"""`mindrun.numbers.arithmetic`, compiled, and the lane functions of kinds that call it."""

from collections.abc import Callable
from types import FunctionType
from typing import Any

from mindrun.numbers import arithmetic, stack_machine
from mindrun.sim import vector
from mindrun.sim.compiling import compiled, inlined

clamp, finite = inlined(arithmetic.clamp), inlined(arithmetic.finite)
sine_cosine, wrapped = inlined(arithmetic.sine_cosine), inlined(arithmetic.wrapped)
_COMPILED: dict[Any, Callable[..., Any]] = {
    arithmetic.bearing: inlined(arithmetic.bearing),
    arithmetic.clamp: clamp,
    arithmetic.finite: finite,
    arithmetic.sine_cosine: sine_cosine,
    arithmetic.wrapped: wrapped,
    arithmetic.short_way: inlined(arithmetic.short_way),
    arithmetic.splat: vector.splat,
    arithmetic.broadcast: vector.broadcast,
    arithmetic.load: vector.load,
    arithmetic.store: vector.store,
    arithmetic.sigmoids: vector.sigmoids,
}


def compiled_lane(function: Any) -> Callable[..., Any]:
    """A function of a kind's module, compiled with those of that module and of `numbers.arithmetic` that it calls."""
    if function not in _COMPILED:
        _COMPILED[function] = compiled(_calling_compiled(function))
    return _COMPILED[function]


def _calling_compiled(function: Any) -> FunctionType:
    """A copy of a function that calls the compiled versions of the functions it calls."""
    names = {
        name: compiled_lane(value) if isinstance(value, FunctionType) and value is not function else value
        for name, value in arithmetic.terms(function).items()
    }
    plain = FunctionType(function.__code__, names, function.__name__)
    plain.__module__, plain.__qualname__ = function.__module__, function.__qualname__
    return plain


place_of, put_thing = compiled_lane(arithmetic.place_of), compiled_lane(arithmetic.put_thing)
size_of, resize_thing = compiled_lane(arithmetic.size_of), compiled_lane(arithmetic.resize_thing)
distance_of, box_of = compiled_lane(arithmetic.distance_of), compiled_lane(arithmetic.box_of)
in_claw, inside = compiled_lane(arithmetic.in_claw), compiled_lane(arithmetic.inside)
nearest = _COMPILED[arithmetic.nearest] = inlined(_calling_compiled(arithmetic.nearest))  # which no call can return
evaluate = compiled_lane(stack_machine.evaluate)
