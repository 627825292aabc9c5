"""Functions of the C library that Chipmunk calls: compiled code calls them by their addresses, for the same bits."""

import ctypes
from typing import Any

import numpy as np

FUNCTIONS = ("pow", "sincos")
POWER, SINE_COSINE = range(len(FUNCTIONS))


def library() -> Any:
    """The addresses of FUNCTIONS, 0 where there is none: uint64. They travel in a table, for the code to be kept."""
    return np.array([_address(name) for name in FUNCTIONS], np.uint64)


def _address(name: str) -> int:
    try:
        return ctypes.cast(getattr(ctypes.CDLL(None), name), ctypes.c_void_p).value or 0
    except (AttributeError, OSError, TypeError):
        return 0
