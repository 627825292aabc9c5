"""Operations on floats that give compiled code what Python gives: the same bits, and `wrong[0]` where it would raise.

The functions of C are called by their addresses, the very ones that Python calls: left to itself a compiler puts its
own in their place, `x * x` for a power.
"""

import ctypes
import math
from collections.abc import Callable, Mapping
from typing import Any

import numba

exactly: Callable[[Callable[..., Any]], Any] = numba.njit(nogil=True, error_model="numpy")


def _from_c(name: str, arguments: int) -> Any:
    """A function of the C library; None where the process has none."""
    try:
        function = getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError, TypeError):
        return None
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * arguments
    return function


_pow, _fmod = _from_c("pow", 2), _from_c("fmod", 2)


@exactly
def divide(wrong, a, b):
    """a / b, as Python divides floats."""
    if b == 0.0:
        wrong[0] = 1
        return 0.0
    return a / b


@exactly
def modulo(wrong, a, b):
    """a % b, with the sign of b."""
    if b == 0.0:
        wrong[0] = 1
        return 0.0
    rest = _fmod(a, b)
    if rest != 0.0:
        return rest + b if (b < 0.0) != (rest < 0.0) else rest
    return math.copysign(0.0, b)


@exactly
def power(wrong, a, b):
    """a ** b for a whole b."""
    if a == 0.0 and b < 0.0:
        wrong[0] = 1
        return 0.0
    result = _pow(a, b)
    if math.isinf(result) and not math.isinf(a):
        wrong[0] = 1
    return result


@exactly
def larger(a, b):
    """max(a, b): the first unless the second is larger."""
    return b if b > a else a


@exactly
def smaller(a, b):
    """min(a, b)."""
    return b if b < a else a


def _checked(function: Any) -> Any:
    """A function of one number that Python refuses to answer with what is not finite."""

    @exactly
    def checked(wrong, x):
        result = function(x)
        if result - result != 0.0 and (x - x == 0.0 or (x == x and result != result)):
            wrong[0] = 1
        return result

    return checked


_ALONE = {
    name: _checked(function)
    for name in ("acos", "asin", "atan", "cos", "exp", "fabs", "log", "sin", "sqrt", "tan", "tanh")
    if (function := _from_c(name, 1)) is not None
}

# What the text of a formula can name, and the names there of functions of Python's `math`.
OPERATIONS: Mapping[str, Any] = _ALONE | {
    "INF": math.inf, "NAN": math.nan, "divide": divide, "modulo": modulo, "power": power, "larger": larger,
    "smaller": smaller,
}  # fmt: skip
MATH: Mapping[Any, str] = {getattr(math, name): name for name in _ALONE}
