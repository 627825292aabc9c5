"""Vectors of float32 as the bytes of .npy files, in the one form in which they are written: numpy's own of version 1.0.

The header of such a file is Python, and numpy evaluates it. Here it is compared with what is written, so nothing that
stands there can be anything else.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MAGIC = b"\x93NUMPY\x01\x00"
LENGTH_BYTES = 2  # of the header's length
HEADER = re.compile(rb"\{'descr': '<f4', 'fortran_order': False, 'shape': \((0|[1-9][0-9]{0,9}),\), \} *\n")
GROWTH_COLUMNS, HEADER_ALIGNMENT = 21, 64  # columns that numpy leaves for the number to grow, bytes that a header fills


def to_npy(vector: NDArray[np.float32]) -> bytes:
    """A vector as a .npy file; the same bytes with any version of numpy."""
    import numpy as np

    size = str(len(vector))
    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({size},), }}{' ' * (GROWTH_COLUMNS - len(size))}"
    before = len(MAGIC) + LENGTH_BYTES
    length = -(-(before + len(header) + 1) // HEADER_ALIGNMENT) * HEADER_ALIGNMENT - before
    header = f"{header:<{length - 1}}\n"
    return (
        MAGIC
        + length.to_bytes(LENGTH_BYTES, "little")
        + header.encode()
        + np.ascontiguousarray(vector, "<f4").tobytes()
    )


def from_npy(data: bytes) -> NDArray[np.float32]:
    """The vector in a .npy file; ValueError unless it is one of finite float32, as it is written here."""
    import numpy as np

    begin = len(MAGIC) + LENGTH_BYTES
    end = begin + int.from_bytes(data[len(MAGIC) : begin], "little")
    found = HEADER.fullmatch(data[begin:end])
    if not data.startswith(MAGIC) or found is None or len(data) != end + 4 * int(found[1]):
        raise ValueError("these are not whole weights as mindc writes them")
    vector = np.frombuffer(data, "<f4", offset=end).astype(np.float32)
    if not np.isfinite(vector).all():
        raise ValueError("these weights are not finite")
    return vector
