"""Frames: what goes from machine to machine. A JSON header, arrays, and the SHA-256 of both; nothing is evaluated.

8 bytes    "mindfrm1"
12 bytes   the lengths of header and arrays: <IQ
header     {"kind": …, "about": {…}, "arrays": {name: [dtype, shape]}}
arrays     one after the other, in the header's order
32 bytes   the SHA-256 of all that

On a stream a newline may follow: srun passes nothing on before a line has ended.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from math import prod
from struct import Struct
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mindrun.files.strict_json import is_whole, parsed

MAGIC = b"mindfrm1"
LENGTHS = Struct("<IQ")
PREFIX_BYTES = len(MAGIC) + LENGTHS.size
DIGEST_BYTES = 32
LINE_END = b"\n"
MAX_HEADER_BYTES = 1 << 20
MAX_ARRAYS_BYTES = 1 << 30
MAX_ARRAYS, MAX_DIMENSIONS = 64, 4
DTYPES = ("<f4", "<f8", "<i8", "<u8", "|u1")

Arrays = Mapping[str, NDArray[Any]]


class FrameError(ValueError):
    """Bytes that are no frame."""


@dataclass(frozen=True, slots=True)
class Frame:
    """What is said, in plain data, and arrays."""

    kind: str
    about: Mapping[str, Any] = field(default_factory=dict)
    arrays: Arrays = field(default_factory=dict)


def pack(frame: Frame) -> bytes:
    """A frame as bytes."""
    arrays = {name: np.ascontiguousarray(array, _dtype(array)) for name, array in frame.arrays.items()}
    shapes = {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
    header = json.dumps({"kind": frame.kind, "about": dict(frame.about), "arrays": shapes}, allow_nan=False).encode()
    body = b"".join(array.tobytes() for array in arrays.values())
    if len(header) > MAX_HEADER_BYTES or len(body) > MAX_ARRAYS_BYTES:
        raise FrameError(f"this is larger than a frame can be ({MAX_ARRAYS_BYTES >> 20} MiB)")
    data = MAGIC + LENGTHS.pack(len(header), len(body)) + header + body
    return data + sha256(data).digest()


def unpack(data: bytes) -> Frame:
    """The frame in these bytes; FrameError unless they are one, whole."""
    header, body = _lengths(data[:PREFIX_BYTES])
    if len(data) != PREFIX_BYTES + header + body + DIGEST_BYTES:
        raise FrameError("it is not as long as it says")
    if sha256(data[:-DIGEST_BYTES]).digest() != data[-DIGEST_BYTES:]:
        raise FrameError("it is damaged")
    return _frame(data[PREFIX_BYTES : PREFIX_BYTES + header], data[PREFIX_BYTES + header : -DIGEST_BYTES])


class Stream(Protocol):
    """What bytes come from."""

    def read(self, size: int, /) -> bytes:
        """At most so many, at least one unless it has ended."""


def read(stream: Stream) -> bytes | None:
    """The bytes of the next frame of a stream, None where it ends before one; FrameError where something else comes."""
    start = stream.read(len(MAGIC))
    if start.startswith(LINE_END):  # of the frame before
        start = start[len(LINE_END) :] or stream.read(len(MAGIC))
    return _begun(stream, start)


def read_first(stream: Stream) -> bytes | None:
    """As `read`, of a stream that has said nothing: no line has ended in it, either."""
    return _begun(stream, stream.read(len(MAGIC)))


def _begun(stream: Stream, start: bytes) -> bytes | None:
    """The bytes of a frame, of which these were the first; what is none is refused without waiting for more."""
    if not start:
        return None
    while start != MAGIC and MAGIC.startswith(start) and (part := stream.read(len(MAGIC) - len(start))):
        start += part
    prefix = start + _exactly(stream, LENGTHS.size) if start == MAGIC else start
    rest = sum(_lengths(prefix)) + DIGEST_BYTES
    data = prefix + _exactly(stream, rest)
    if len(data) < PREFIX_BYTES + rest:
        raise FrameError("it ends in its middle")
    return data


def _exactly(stream: Stream, size: int) -> bytes:
    """So many bytes, or fewer where the stream ends."""
    parts, left = list[bytes](), size
    while left and (part := stream.read(min(left, 1 << 20))):  # a length that lies takes no memory
        parts.append(part)
        left -= len(part)
    return b"".join(parts)


def _lengths(prefix: bytes) -> tuple[int, int]:
    if len(prefix) < PREFIX_BYTES or not prefix.startswith(MAGIC):
        raise FrameError(f"it begins with {prefix[: len(MAGIC)]!r}")
    header, body = LENGTHS.unpack_from(prefix, len(MAGIC))
    if header > MAX_HEADER_BYTES or body > MAX_ARRAYS_BYTES:
        raise FrameError(f"it is larger than a frame can be ({MAX_ARRAYS_BYTES >> 20} MiB)")
    return header, body


def _frame(header: bytes, body: bytes) -> Frame:
    try:
        said = parsed(header, MAX_HEADER_BYTES)
    except ValueError as error:
        raise FrameError(f"its header is no JSON ({error})") from error
    match said:
        case {"kind": str(kind), "about": dict(about), "arrays": dict(shapes)} if len(said) == 3:
            return Frame(kind, about, _arrays(shapes, body))
    raise FrameError("its header says other things than a frame's")


def _arrays(shapes: dict[str, Any], body: bytes) -> dict[str, NDArray[Any]]:
    arrays, start = {}, 0
    if len(shapes) > MAX_ARRAYS:
        raise FrameError(f"it has more than {MAX_ARRAYS} arrays")
    for name, said in shapes.items():
        match said:
            case [str(dtype), [*shape]] if (
                dtype in DTYPES and len(shape) <= MAX_DIMENSIONS and all(is_whole(n, 0, 1 << 31) for n in shape)
            ):
                size = prod(shape) * np.dtype(dtype).itemsize
            case _:
                raise FrameError(f"its array {name!r:.40} is none that a frame can have")
        if start + size > len(body):
            raise FrameError("its arrays are larger than it is")
        arrays[name] = np.frombuffer(body[start : start + size], dtype).reshape(shape).copy()
        start += size
    if start != len(body):
        raise FrameError("it is larger than its arrays")
    return arrays


def _dtype(array: NDArray[Any]) -> str:
    found = array.dtype.newbyteorder("<").str
    if found not in DTYPES:
        raise FrameError(f"a frame has no arrays of {array.dtype}")
    return found
