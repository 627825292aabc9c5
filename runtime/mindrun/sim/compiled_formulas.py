"""Formulas compiled by numba, to be called from the lanes: imported only where a mind has procedures."""

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from numba import types
from numba.np.unsafe.ndarray import to_fixed_tuple

from mindrun.numbers.arithmetic import F
from mindrun.sim.exact import exactly
from mindrun.sim.formulas import NoFormulaError, formula

# the lane in which it fails or −1; inputs, outputs, lanes, the distance between rows in floats
SIGNATURE = types.intp(types.CPointer(types.float32), types.CPointer(types.float32), types.intp, types.intp)


def compile_formula(function: Callable[..., Any], source: str, inputs: int, outputs: int) -> Any:
    """A C function (keep it alive; `.address`) that runs a function of a module's text in every lane.

    NoFormulaError where it is no formula, or numba cannot compile it.
    """
    plain = formula(function, source, inputs, outputs)
    try:
        return numba.cfunc(SIGNATURE)(_looped(exactly(plain), inputs, outputs))
    except Exception as error:  # numba fails in many ways, and whatever it cannot compile runs in Python
        raise NoFormulaError(str(error).split("\n")[0]) from error


def _looped(one: Any, inputs: int, outputs: int) -> Callable[..., int]:
    def loop(source: Any, target: Any, lanes: int, stride: int) -> int:
        values = numba.carray(source, (inputs, stride))
        results = numba.carray(target, (outputs, stride))
        given, wrong = np.empty(inputs), np.zeros(1, np.int64)
        for k in range(lanes):
            sound = True
            for j in range(inputs):
                given[j] = values[j, k]
                sound = sound and given[j] - given[j] == 0.0
            if sound:  # nobody is asked for what is not sent
                result = one(wrong, *to_fixed_tuple(given, inputs))
                if wrong[0]:
                    return k
                for q, value in enumerate(result):
                    results[q, k] = F(value)
        return -1

    return loop
