"""Files of safetensors: what is refused, in one sentence."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.errors import WeightsError
from mindrun.files.printable import visible
from safetensors.numpy import save

from mindlang.weights.network import from_bytes

WHOLE = save({"a": np.ones((2, 3), np.float32)}, {"mind.reads": "eye:3"})


def file_of(header: Mapping[str, Any] | bytes, data: bytes = b"") -> bytes:
    """A file with this header."""
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    return len(text).to_bytes(8, "little") + text + data


def tensor(begin: int, end: int, shape: object = (1,), dtype: object = "F32") -> dict[str, object]:
    """What a header says of a tensor."""
    return {"dtype": dtype, "shape": shape, "data_offsets": [begin, end]}


def test_there_and_back() -> None:
    found = from_bytes(WHOLE)
    assert {name: matrix.tolist() for name, matrix in found.by_name.items()} == {"a": [[1, 1, 1], [1, 1, 1]]}
    assert found.metadata == {"mind.reads": "eye:3"}
    assert from_bytes(save({"a": np.ones(1, np.float32)})).metadata == {}


HOSTILE: dict[str, tuple[bytes, str]] = {
    "nothing": (b"", "it is no file of safetensors that can be read: "),
    "a huge header": (b"\xff" * 8 + b"{}", "header too large"),
    "a header cut off": (file_of({})[:-1], "invalid header length"),
    "no JSON": (file_of(b"{]"), "invalid JSON"),
    "deep": (file_of(b"{" + b'"a":[' * 100_000), "it is no file of safetensors"),
    "other metadata": (file_of({"__metadata__": {"a": 1}}), "it is no file of safetensors"),
    "a hole": (file_of({"a": tensor(4, 8)}, b"12345678"), "it is no file of safetensors"),
    "too little for its shape": (file_of({"a": tensor(0, 4, [2, 2])}, b"1234"), "it is no file of safetensors"),
    "many axes": (file_of({"a": tensor(0, 4, [1] * 100)}, b"1234"), "it is no file of safetensors"),
    "data behind": (WHOLE + b"x", "it is no file of safetensors"),
    "float16": (file_of({"a": tensor(0, 2, dtype="F16")}, b"12"), "a is float16, and weights are float32"),
    "bfloat16": (file_of({"a": tensor(0, 2, dtype="BF16")}, b"12"), "it is no file of safetensors"),
    "not printable": (file_of({"\x1b[2J": tensor(0, 1, dtype="I8")}, b"1"), "is int8, and weights are float32"),
}  # fmt: skip


@pytest.mark.parametrize(("data", "message"), HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_file_is_one_sentence(data: bytes, message: str) -> None:
    with pytest.raises(WeightsError, match=r"^[^\n]+$") as error:
        from_bytes(data)
    assert message in str(error.value)
    assert visible(str(error.value)) == str(error.value)


@given(st.binary(min_size=8, max_size=64), st.integers(0, len(WHOLE) - 1))
def test_no_bytes_raise_anything_else(noise: bytes, end: int) -> None:
    for hostile in (noise, WHOLE + noise, WHOLE[:end]):
        with pytest.raises(WeightsError, match=r"^.{,500}$"):
            from_bytes(hostile)
