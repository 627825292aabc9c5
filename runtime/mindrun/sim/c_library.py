"""Functions of the C library that Chipmunk calls: compiled code calls them by their addresses, for the same bits."""

import ctypes
import os
from typing import Any

import numpy as np

POWER, SINE, COSINE = range(3)


def library() -> Any:
    """The addresses of `pow`, `sin` and `cos`: uint64. They travel in a table, for the code to be kept."""
    c = ctypes.CDLL("ucrtbase" if os.name == "nt" else None)
    return np.array([ctypes.cast(function, ctypes.c_void_p).value for function in (c.pow, c.sin, c.cos)], np.uint64)
