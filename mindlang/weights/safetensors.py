"""The form of safetensors: a header of JSON that says where each tensor lies, and the tensors.

Own code of a page, so that nothing else has to be installed. Of the form it takes what weights are: float32, row by
row, one tensor behind the other. https://huggingface.co/docs/safetensors
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import prod
from typing import Any

import numpy as np
from mindrun.errors import WeightsError
from mindrun.files.printable import visible
from mindrun.files.strict_json import is_whole, parsed
from numpy.typing import NDArray

LENGTH_BYTES = 8  # of the header's length, before it
MAX_HEADER_BYTES = 1 << 20
HEADER_ALIGNMENT = 8  # bytes that a header fills with spaces
METADATA = "__metadata__"
MAX_AXES = 8  # of a tensor; weights have two
MAX_NUMBERS = 1 << 31  # in a tensor, also where one of its axes is empty
FLOAT32 = "F32"

Matrix = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Tensors:
    """The tensors of a file by name, and what it says of itself."""

    by_name: Mapping[str, Matrix]
    metadata: Mapping[str, str] = field(default_factory=dict)


def to_safetensors(tensors: Tensors) -> bytes:
    """Tensors of float32 as a file; the same bytes for the same tensors."""
    header: dict[str, Any] = {METADATA: dict(tensors.metadata)} if tensors.metadata else {}
    begin = 0
    for name, tensor in tensors.by_name.items():
        end = begin + 4 * tensor.size
        header[name] = {"dtype": FLOAT32, "shape": list(tensor.shape), "data_offsets": [begin, end]}
        begin = end
    text = json.dumps(header, separators=(",", ":"), ensure_ascii=False).encode()
    text += b" " * (-len(text) % HEADER_ALIGNMENT)
    data = b"".join(np.ascontiguousarray(tensor, "<f4").tobytes() for tensor in tensors.by_name.values())
    return len(text).to_bytes(LENGTH_BYTES, "little") + text + data


def from_safetensors(data: bytes) -> Tensors:
    """The tensors of a file; WeightsError unless it is whole, and has nothing but float32 without holes."""
    length = int.from_bytes(data[:LENGTH_BYTES], "little")
    if len(data) < LENGTH_BYTES:
        raise WeightsError("it is cut off: it has no header")
    if length > MAX_HEADER_BYTES:
        raise WeightsError(f"its header says that it is {length:,} bytes long, and may be {MAX_HEADER_BYTES:,}")
    if LENGTH_BYTES + length > len(data):
        raise WeightsError(f"it is cut off: its header is {length:,} bytes long, and the whole file {len(data):,}")
    header = _header(data[LENGTH_BYTES : LENGTH_BYTES + length])
    metadata = header.pop(METADATA, {})
    if not isinstance(metadata, dict) or not all(isinstance(value, str) for value in metadata.values()):
        raise WeightsError(f"its {METADATA} is not text by name")
    places = {name: _place(name, about) for name, about in header.items()}
    body = data[LENGTH_BYTES + length :]
    _refuse_holes(places, len(body))
    return Tensors({name: _tensor(body, place) for name, place in places.items()}, metadata)


@dataclass(frozen=True, slots=True)
class _Place:
    shape: tuple[int, ...]
    begin: int
    end: int


def _header(text: bytes) -> dict[str, Any]:
    try:
        found = parsed(text, MAX_HEADER_BYTES)
    except ValueError as error:
        raise WeightsError(f"its header is no JSON: {visible(str(error))}") from error
    if not isinstance(found, dict):
        raise WeightsError("its header is no table of tensors")
    return found


def _place(name: str, about: object) -> _Place:
    """Where a tensor lies; WeightsError where what the header says of it does not fit itself."""
    shown = _shown(name)
    if not isinstance(about, dict) or about.keys() != {"dtype", "shape", "data_offsets"}:
        raise WeightsError(f"its header does not say dtype, shape and data_offsets of {shown}")
    if about["dtype"] != FLOAT32:
        kind = visible(f"{about['dtype']!s:.20}")
        raise WeightsError(f"{shown} is {kind}, and weights are {FLOAT32}", "save it as float32: skill.float()")
    shape, offsets = about["shape"], about["data_offsets"]
    if not _is_shape(shape):
        raise WeightsError(f"the shape of {shown} is none")
    if not isinstance(offsets, list) or len(offsets) != 2 or not all(map(is_whole, offsets)):
        raise WeightsError(f"the data_offsets of {shown} are not two whole numbers")
    begin, end = offsets
    if end - begin != 4 * prod(shape):
        raise WeightsError(f"{shown} has {end - begin:,} bytes, and its shape needs {4 * prod(shape):,}")
    return _Place(tuple(shape), begin, end)


def _is_shape(shape: object) -> bool:
    if not isinstance(shape, list) or len(shape) > MAX_AXES or not all(map(is_whole, shape)):
        return False
    numbers: int = prod(max(each, 1) for each in shape)
    return numbers <= MAX_NUMBERS


def _shown(name: str) -> str:
    return visible(f"{name:.60}") or "a tensor without a name"


def _refuse_holes(places: Mapping[str, _Place], size: int) -> None:
    """WeightsError unless the tensors lie one behind the other, from the first byte to the last."""
    at = 0
    for name, place in sorted(places.items(), key=lambda item: (item[1].begin, item[1].end)):
        shown = _shown(name)
        if place.begin < at:
            raise WeightsError(f"{shown} lies over another tensor")
        if place.begin > at:
            raise WeightsError(f"before {shown} are {place.begin - at:,} bytes of no tensor")
        at = place.end
    if at > size:
        raise WeightsError(f"it is cut off: its tensors need {at:,} bytes, and {size:,} are there")
    if at < size:
        raise WeightsError(f"behind its tensors are {size - at:,} bytes of none")


def _tensor(body: bytes, place: _Place) -> Matrix:
    flat = np.frombuffer(body, "<f4", prod(place.shape), place.begin)
    return flat.astype(np.float32).reshape(place.shape)
