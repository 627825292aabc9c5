"""Decorators that compile the lanes, into one piece of machine code for each way in from Python.

Numba would optimise every function and make machine code of it, link it into each caller, and do all that again there,
five levels deep. Here what only compiled code calls stays as it was lowered until it is part of a way in.
"""

from collections.abc import Callable
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from mindrun.sim.cache import MachineCode
from mindrun.sim.numba_internals import EntryCompiler, InnerCompiler, callback_of, keep_code

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]
# They own no array and make none. With `_nrt` numba would count the references of all that they are handed, at every
# call: half of the time of a tick.
OPTIONS = {"nogil": True, "error_model": "numpy", "_nrt": False}
compiled: Decorator = numba.njit(
    pipeline_class=InnerCompiler, no_cpython_wrapper=True, no_cfunc_wrapper=True, forceinline=False, **OPTIONS
)
inlined: Decorator = numba.njit(inline="always", **OPTIONS)
# A part of a tick becomes a part of its caller: a call would hand over a hundred arrays, which takes as long as a lane.
part_of_tick: Decorator = numba.njit(
    pipeline_class=InnerCompiler, no_cpython_wrapper=True, no_cfunc_wrapper=True, forceinline=True, **OPTIONS
)


def entry(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function, even one that is a part of others, so that Python can call it; its machine code is kept."""
    function = getattr(function, "py_func", function)
    dispatcher: Any = numba.njit(pipeline_class=EntryCompiler, **OPTIONS)(function)
    keep_code(dispatcher, _code_of(function))
    return dispatcher  # type: ignore[no-any-return]


def callback(signature: Any) -> Callable[[Callable[..., Any]], Any]:
    """A function for C, which calls its `address`; its machine code is kept."""
    return lambda function: callback_of(function, signature, _code_of(function))


@intrinsic  # type: ignore[untyped-decorator]
def call(typingctx: Any, address: Any, *arguments: Any) -> Any:
    """Call the C function at an address with whole numbers, pointers and doubles; its result as a uint64."""
    given = tuple(types.float64 if isinstance(a, types.Float) else types.uint64 for a in arguments)
    signature = types.uint64(types.uint64, types.StarArgTuple(given))

    def generate(context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        double, whole = ir.DoubleType(), ir.IntType(64)
        kinds = [double if kind is types.float64 else whole for kind in given]
        function = builder.inttoptr(values[0], ir.FunctionType(whole, kinds).as_pointer())
        return builder.call(function, [builder.extract_value(values[1], i) for i in range(len(given))])

    return signature, generate


def _code_of(function: Callable[..., Any]) -> MachineCode:
    return MachineCode(f"{function.__module__.rpartition('.')[2]}.{function.__name__}")
