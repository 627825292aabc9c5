"""The form of safetensors: there and back, as the library has it, and refused in one sentence where it is hostile."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from mindrun.errors import WeightsError
from mindrun.files.printable import visible

from mindlang.weights.safetensors import MAX_HEADER_BYTES, Tensors, from_safetensors, to_safetensors

MATRICES = arrays(np.float32, array_shapes(max_dims=3, min_side=0, max_side=5), elements=st.floats(width=32))
TEXTS = st.text(max_size=9)
TENSORS = st.builds(
    Tensors,
    st.dictionaries(TEXTS.filter(lambda name: name != "__metadata__"), MATRICES, max_size=4),
    st.dictionaries(TEXTS, TEXTS, max_size=2),
)


def file_of(header: Mapping[str, Any] | bytes, data: bytes = b"") -> bytes:
    """A file with this header."""
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    return len(text).to_bytes(8, "little") + text + data


def tensor(begin: int, end: int, shape: object = (1,), dtype: object = "F32") -> dict[str, object]:
    """What a header says of a tensor."""
    return {"dtype": dtype, "shape": shape, "data_offsets": [begin, end]}


def same(one: Tensors, other: Tensors) -> bool:
    """Whether all bits are the same."""
    return one.metadata == other.metadata and {k: (v.shape, v.tobytes()) for k, v in one.by_name.items()} == {
        k: (v.shape, v.tobytes()) for k, v in other.by_name.items()
    }


@given(TENSORS)
def test_there_and_back(tensors: Tensors) -> None:
    data = to_safetensors(tensors)
    assert same(from_safetensors(data), tensors)
    assert to_safetensors(from_safetensors(data)) == data


@given(TENSORS)
def test_the_library_reads_what_is_written(tensors: Tensors) -> None:
    library = pytest.importorskip("safetensors.numpy", reason="pip install safetensors")
    assert same(Tensors(library.load(to_safetensors(tensors)), tensors.metadata), tensors)


@given(TENSORS)
def test_what_the_library_writes_is_read(tensors: Tensors) -> None:
    library = pytest.importorskip("safetensors.numpy", reason="pip install safetensors")
    assert same(from_safetensors(library.save(dict(tensors.by_name), dict(tensors.metadata) or None)), tensors)


@given(st.binary(max_size=64), TENSORS)
def test_no_bytes_raise_anything_else(noise: bytes, tensors: Tensors) -> None:
    data = to_safetensors(tensors)
    cut = data[: len(noise) * len(data) // 64]
    for hostile in (noise, data + noise + b"x", file_of(noise), cut):
        if hostile != data:
            with pytest.raises(WeightsError):
                from_safetensors(hostile)


NUMBERS = st.integers() | st.sampled_from([0, 1, 4, 1 << 31, 1 << 53, 1 << 64])
ANYTHING = st.recursive(
    st.none() | st.booleans() | NUMBERS | st.floats() | TEXTS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=4),
    max_leaves=8,
)
PLACES = st.fixed_dictionaries(
    {
        "dtype": st.just("F32") | st.just("F32") | ANYTHING,
        "shape": st.lists(NUMBERS, max_size=80) | ANYTHING,
        "data_offsets": st.lists(NUMBERS, min_size=2, max_size=2) | ANYTHING,
    }
)


@given(st.dictionaries(TEXTS | st.just("__metadata__"), PLACES | ANYTHING, max_size=3), st.binary(max_size=16))
def test_no_header_raises_anything_else(header: dict[str, Any], data: bytes) -> None:
    said = ""
    try:
        tensors = from_safetensors(file_of(header, data))
    except WeightsError as error:
        said = str(error)
    else:
        assert 4 * sum(matrix.size for matrix in tensors.by_name.values()) == len(data)
    assert visible(said) == said
    assert len(said) < 500


HOSTILE: dict[str, tuple[bytes, str]] = {
    "nothing": (b"", "it is cut off: it has no header"),
    "a huge header": (b"\xff" * 8 + b"{}", f"its header says that it is {2**64 - 1:,} bytes long"),
    "a large header": (file_of(b" " * (MAX_HEADER_BYTES + 1)), f"and may be {MAX_HEADER_BYTES:,}"),
    "a header cut off": (file_of({})[:-1], "it is cut off: its header is 2 bytes long"),
    "no JSON": (file_of(b"{]"), "its header is no JSON"),
    "no text": (file_of(b'{"\xff": 1}'), "its header is no JSON"),
    "deep": (file_of(b"[" * 100_000), "its header is no JSON: it is nested too deep"),
    "no table": (file_of(b"[]"), "its header is no table of tensors"),
    "other metadata": (file_of({"__metadata__": {"a": 1}}), "its __metadata__ is not text by name"),
    "no place": (file_of({"a": {}}), "its header does not say dtype, shape and data_offsets of a"),
    "more of a place": (file_of({"a": tensor(0, 4) | {"b": 1}}, b"1234"), "does not say dtype"),
    "float16": (file_of({"a": tensor(0, 2, dtype="F16")}, b"12"), "a is F16, and weights are F32"),
    "a dtype of many": (file_of({"a": tensor(0, 4, dtype=["F32"])}, b"1234"), "and weights are F32"),
    "a negative shape": (file_of({"a": tensor(0, 4, [-1, -1])}, b"1234"), "the shape of a is none"),
    "a huge shape": (file_of({"a": tensor(0, 4, [2**40])}, b"1234"), "the shape of a is none"),
    "many axes": (file_of({"a": tensor(0, 4, [1] * 100)}, b"1234"), "the shape of a is none"),
    "huge, and empty": (file_of({"a": tensor(0, 0, [0, 2**31, 2**31])}), "the shape of a is none"),
    "too little for its shape": (file_of({"a": tensor(0, 4, [2, 2])}, b"1234"), "has 4 bytes, and its shape needs 16"),
    "a true offset": (file_of({"a": tensor(False, 4)}, b"1234"), "the data_offsets of a are not two whole numbers"),
    "overlapping": (
        file_of({"a": tensor(0, 8, [2]), "b": tensor(4, 8)}, b"12345678"),
        "b lies over another tensor",
    ),
    "a hole": (file_of({"a": tensor(4, 8)}, b"12345678"), "before a are 4 bytes of no tensor"),
    "a name twice": (
        file_of(b'{"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]},"a":{"dtype":"F32","shape":[1],'
                b'"data_offsets":[4,8]}}', b"12345678"),
        "its header is no JSON: a stands there twice",
    ),
    "no name": (file_of({"": tensor(0, 4, [2])}, b"1234"), "a tensor without a name has 4 bytes"),
    "negative offsets": (file_of({"a": tensor(-4, 0)}, b"1234"), "the data_offsets of a are not two whole numbers"),
    "offsets turned over": (file_of({"a": tensor(8, 4)}, b"12345678"), "a has -4 bytes, and its shape needs 4"),
    "float64": (file_of({"a": tensor(0, 8, dtype="F64")}, b"12345678"), "a is F64, and weights are F32"),
    "bfloat16": (file_of({"a": tensor(0, 2, dtype="BF16")}, b"12"), "a is BF16, and weights are F32"),
    "whole numbers": (file_of({"a": tensor(0, 1, dtype="I8")}, b"1"), "a is I8, and weights are F32"),
    "more digits than Python reads": (
        file_of(b'{"a":{"dtype":"F32","shape":[' + b"9" * 5000 + b"]}}"), "its header is no JSON: Exceeds the limit",
    ),
    "nothing in something": (
        file_of({"a": tensor(0, 8, [2]), "b": tensor(4, 4, [0])}, b"12345678"), "b lies over another tensor",
    ),
    "data cut off": (file_of({"a": tensor(0, 4)}, b"123"), "it is cut off: its tensors need 4 bytes, and 3 are there"),
    "data behind": (file_of({"a": tensor(0, 4)}, b"12345"), "behind its tensors are 1 bytes of none"),
}  # fmt: skip


@pytest.mark.parametrize(("data", "message"), HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_file_is_one_sentence(data: bytes, message: str) -> None:
    with pytest.raises(WeightsError, match=r"^[^\n]+$") as error:
        from_safetensors(data)
    assert message in str(error.value)


def test_what_is_not_printable_is_not_printed() -> None:
    with pytest.raises(WeightsError) as error:
        from_safetensors(file_of({"\x1b[2J": {}}))
    assert "\x1b" not in str(error.value)
