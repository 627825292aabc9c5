"""Vectors of float32 as the bytes of .npy files, in the one form in which they are written: numpy's own of version 1.0.

The header of such a file is a Python literal. It is never read: a file is taken if it is what is written here, byte
for byte.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MAGIC = b"\x93NUMPY\x01\x00v\x00"  # with the version, and the header's length, 118
HEADER_BYTES = 128  # of both


def to_npy(vector: "NDArray[np.float32]") -> bytes:
    """A vector as a .npy file; the same bytes with any version of numpy."""
    import numpy as np

    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({len(vector)},), }}"
    filled = f"{header:<{HEADER_BYTES - len(MAGIC) - 1}}\n".encode()
    return MAGIC + filled + np.ascontiguousarray(vector, "<f4").tobytes()


def from_npy(data: bytes) -> "NDArray[np.float32]":
    """The vector in a .npy file; ValueError unless it is one of finite float32, as it is written here."""
    import numpy as np

    numbers = data[HEADER_BYTES : len(data) - len(data) % 4]
    vector = np.frombuffer(numbers, "<f4").astype(np.float32)
    if to_npy(vector) != data:
        raise ValueError("these are not whole weights as mindc writes them")
    if not np.isfinite(vector).all():
        raise ValueError("these weights are not finite")
    return vector
