"""Procedures inside the lanes: a Python function compiled by numba and called through its address.

A procedure that numba cannot compile still runs, in Python, between the two halves of every tick.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.unsafe.ndarray import to_fixed_tuple

from mindrun.functions import Procedure
from mindrun.functions.procedure import load, module_source
from mindrun.graph import Graph, Skill
from mindrun.sim.lanes.arithmetic import F, compiled
from mindrun.weights import reachable

# inputs, how many, outputs, how many, lanes, the distance between rows in floats
SIGNATURE = types.void(types.CPointer(types.float32), types.CPointer(types.float32), types.intp, types.intp)


@intrinsic
def call_address(typingctx, address, inputs, outputs, lanes, stride):
    """Call a C function with the type of SIGNATURE that stands at an address."""
    signature = types.void(types.uint64, types.uintp, types.uintp, types.intp, types.intp)

    def generate(context, builder, _signature, arguments):
        address, inputs, outputs, lanes, stride = arguments
        pointer = cgutils.voidptr_t
        whole = context.get_value_type(types.intp)
        function_type = ir.FunctionType(ir.VoidType(), [pointer, pointer, whole, whole])
        function = builder.inttoptr(address, function_type.as_pointer())
        given = [builder.inttoptr(inputs, pointer), builder.inttoptr(outputs, pointer), lanes, stride]
        builder.call(function, given)
        return context.get_dummy_value()

    return signature, generate


@compiled
def call(address, gathered, inputs, hidden, outputs, n):
    """Run a compiled procedure over the gathered inputs; its outputs are the first rows of `hidden`."""
    call_address(address, gathered.ctypes.data, hidden.ctypes.data, n, gathered.shape[1])


class NotCompilableError(Exception):
    """Numba cannot compile a procedure; it runs in Python."""


def compile_procedure(function: Callable[..., Any], inputs: int, outputs: int) -> Any:
    """A C function (keep it alive; `.address`) that runs the procedure in every lane. Raises NotCompilableError."""
    given = (types.float64,) * inputs
    try:
        scalar = numba.njit(error_model="numpy", nogil=True)(function)
        scalar.compile(given)
        result = scalar.overloads[given].signature.return_type
        single = isinstance(result, types.Number | types.Boolean)
        if outputs != (1 if single else getattr(result, "count", None)):
            raise NotCompilableError(f"it returns {result}, not {outputs} numbers")
        return numba.cfunc(SIGNATURE)(_looped(scalar, inputs, outputs, single))
    except NotCompilableError:
        raise
    except Exception as error:  # numba fails in many ways, and whatever it cannot compile runs in Python
        raise NotCompilableError(str(error).splitlines()[0]) from error


def _looped(scalar: Any, inputs: int, outputs: int, single: bool) -> Callable[..., None]:
    def one(source, target, lanes, stride):
        values = numba.carray(source, (inputs, stride))
        results = numba.carray(target, (1, stride))
        given = np.empty(inputs)
        for k in range(lanes):
            for j in range(inputs):
                given[j] = values[j, k]
            results[0, k] = F(scalar(*to_fixed_tuple(given, inputs)))

    def several(source, target, lanes, stride):
        values = numba.carray(source, (inputs, stride))
        results = numba.carray(target, (outputs, stride))
        given = np.empty(inputs)
        for k in range(lanes):
            for j in range(inputs):
                given[j] = values[j, k]
            result = scalar(*to_fixed_tuple(given, inputs))
            for q, value in enumerate(result):
                results[q, k] = F(value)

    return one if single else several


class Procedures:
    """The procedures that a master can reach: `addresses` of the compiled ones, `slow` ones by skill, with the reason.

    Raises ProcedureError where a module or function is not there.
    """

    def __init__(self, graph: Graph, master: str, folder: Path | None) -> None:
        self.addresses: dict[str, int] = {}
        self.slow: dict[str, str] = {}
        self.functions: dict[str, Callable[..., Any]] = {}
        self._kept: list[Any] = []
        for skill in reachable(graph, master):
            if isinstance(skill.function, Procedure):
                self._prepare(skill, skill.function, folder or Path())

    def _prepare(self, skill: Skill, procedure: Procedure, folder: Path) -> None:
        function = load(procedure, {procedure.module: module_source(procedure, folder)})
        self.functions[skill.name] = function
        try:
            compiled_one = compile_procedure(function, len(skill.inputs), skill.outputs)
        except NotCompilableError as error:
            self.slow[skill.name] = str(error)
        else:
            self._kept.append(compiled_one)
            self.addresses[skill.name] = compiled_one.address
