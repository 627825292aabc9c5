"""Frames: read back to the bit, or refused in words; no length that lies takes memory."""

import json
from hashlib import sha256
from io import BytesIO

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from mindrun.work.frame import DTYPES, LENGTHS, MAGIC, Frame, FrameError, pack, read, unpack

ARRAYS = st.dictionaries(
    st.text(max_size=5),
    st.sampled_from(DTYPES).flatmap(lambda dtype: arrays(dtype, array_shapes(min_dims=0, max_dims=3, min_side=0))),
    max_size=4,
)
ABOUT = st.dictionaries(
    st.text(max_size=5), st.none() | st.booleans() | st.integers() | st.text(max_size=9), max_size=4
)
FRAME = Frame("advance", {"seed": 1}, {"a": np.arange(6, dtype=np.float32).reshape(2, 3), "b": np.zeros((0, 4))})


@given(st.text(max_size=9), ABOUT, ARRAYS)
def test_a_frame_reads_back_to_the_bit(kind: str, about: dict[str, object], found: dict[str, np.ndarray]) -> None:
    data = pack(Frame(kind, about, found))
    again = unpack(data)
    assert (again.kind, again.about, [*again.arrays]) == (kind, about, [*found])
    assert pack(again) == data
    assert all(again.arrays[name].tobytes() == array.tobytes() for name, array in found.items())
    stream = BytesIO(data + data)
    assert [read(stream), read(stream), read(stream)] == [data, data, None]


def test_every_truncation_and_every_flipped_bit_is_refused() -> None:
    data = pack(FRAME)
    for length in range(len(data)):
        with pytest.raises(FrameError):
            unpack(data[:length])
        if length:
            with pytest.raises(FrameError):
                read(BytesIO(data[:length]))
    for place in range(8 * len(data)):
        damaged = bytearray(data)
        damaged[place // 8] ^= 1 << place % 8
        with pytest.raises(FrameError):
            unpack(bytes(damaged))


@given(st.binary(max_size=200))
def test_garbage_is_no_frame(data: bytes) -> None:
    with pytest.raises(FrameError):
        unpack(data)


def sealed(header: object, body: bytes = b"") -> bytes:
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    data = MAGIC + LENGTHS.pack(len(text), len(body)) + text + body
    return data + sha256(data).digest()


EMPTY = {"kind": "k", "about": {}, "arrays": {}}
HOSTILE = {
    "no JSON": b"{",
    "nested": b"[" * 100_000,
    "NaN": b'{"kind": "k", "about": {"a": NaN}, "arrays": {}}',
    "more": EMPTY | {"more": 1},
    "fewer": {"kind": "k", "about": {}},
    "a kind that is none": EMPTY | {"kind": 3},
    "objects": EMPTY | {"arrays": {"a": ["|O", [0]]}},
    "texts": EMPTY | {"arrays": {"a": ["<U9", [0]]}},
    "a shape below nothing": EMPTY | {"arrays": {"a": ["<f4", [-1]]}},
    "a shape that is none": EMPTY | {"arrays": {"a": ["<f4", [1.5]]}},
    "more than there is": EMPTY | {"arrays": {"a": ["<f4", [2**31 - 1, 2**31 - 1]]}},
    "many dimensions": EMPTY | {"arrays": {"a": ["<f4", [0] * 40]}},
    "many arrays": EMPTY | {"arrays": {str(number): ["<f4", [0]] for number in range(1000)}},
}


@pytest.mark.parametrize("what", HOSTILE)
def test_a_frame_that_says_what_cannot_be_is_refused_though_its_hash_is_right(what: str) -> None:
    assert unpack(sealed(EMPTY)) == Frame("k")
    with pytest.raises(FrameError):
        unpack(sealed(HOSTILE[what]))


def test_what_follows_the_arrays_is_refused() -> None:
    with pytest.raises(FrameError, match="larger than its arrays"):
        unpack(sealed(EMPTY, b"more"))


@pytest.mark.parametrize("between", [b"", b"\n"])
def test_a_stream_has_frame_after_frame(between: bytes) -> None:
    frames = [pack(FRAME), pack(Frame("k"))]
    stream = BytesIO(b"".join(frame + between for frame in frames))
    assert [read(stream), read(stream), read(stream)] == [*frames, None]


@pytest.mark.parametrize("lengths", [(2**32 - 1, 0), (0, 2**64 - 1), (10, 2**30)])
def test_a_length_that_lies_takes_no_memory(lengths: tuple[int, int]) -> None:
    with pytest.raises(FrameError):
        read(BytesIO(MAGIC + LENGTHS.pack(*lengths) + b"{}"))


@pytest.mark.parametrize("array", [np.array([None]), np.array(["a"]), np.zeros(2, complex)])
def test_what_a_frame_cannot_have_is_not_written(array: np.ndarray) -> None:
    with pytest.raises(FrameError):
        pack(Frame("k", {}, {"a": array}))
