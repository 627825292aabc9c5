"""Weights as .npy: numpy's own bytes, and of what numpy would evaluate nothing is read."""

from io import BytesIO

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mindrun.files.npy import from_npy, to_npy

VECTORS = arrays(np.float32, st.integers(0, 200), elements=st.floats(-100, 100, width=32))


def saved(array: np.ndarray, version: tuple[int, int] = (1, 0)) -> bytes:
    """The bytes that numpy writes."""
    file = BytesIO()
    np.lib.format.write_array(file, array, version=version)
    return file.getvalue()


@given(VECTORS)
def test_the_bytes_are_numpy_s_own(vector: np.ndarray) -> None:
    assert to_npy(vector) == saved(vector)
    assert from_npy(to_npy(vector)).tobytes() == vector.tobytes()


def header(text: bytes, values: bytes = bytes(4)) -> bytes:
    """A file with this header."""
    return b"\x93NUMPY\x01\x00" + (len(text) + 1).to_bytes(2, "little") + text + b"\n" + values


SOUND = b"{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }"
STRANGE = {
    "nothing": b"",
    "only its magic": b"\x93NUMPY",
    "another magic": b"X" + saved(np.ones(1, np.float32))[1:],
    "a version that it is not": saved(np.ones(1, np.float32)).replace(b"NUMPY\x01", b"NUMPY\x02"),
    "version 2": saved(np.ones(1, np.float32), (2, 0)),
    "float64": saved(np.ones(1)),
    "big-endian": saved(np.ones(1, ">f4")),
    "a matrix": saved(np.ones((1, 1), np.float32)),
    "a number": saved(np.float32(1)),
    "a record": saved(np.zeros(1, [("a", "<f4")])),
    "columns first": header(SOUND.replace(b"False", b"True")),
    "a header that ends early": header(SOUND[:-9]),
    "a header in a header": header(b"(" * 5000 + b")" * 5000),
    "keys of two kinds": header(SOUND[:-1] + b"3: 4}"),
    "one key more": header(SOUND[:-1] + b"'more': 1, }"),
    "less than nothing": header(SOUND.replace(b"(1,)", b"(-1,)"), b""),
    "a long number": header(SOUND.replace(b"(1,)", b"(" + b"9" * 5000 + b",)")),
    "more than is there": header(SOUND.replace(b"(1,)", b"(2,)")),
    "less than is there": header(SOUND, bytes(8)),
    "no number": saved(np.full(1, np.nan, np.float32)),
    "no finite number": saved(np.full(1, np.inf, np.float32)),
}


@pytest.mark.parametrize("what", STRANGE)
def test_nothing_else_is_read(what: str) -> None:
    with pytest.raises(ValueError, match="these"):
        from_npy(STRANGE[what])
