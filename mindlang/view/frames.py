"""Rows as bytes: six little-endian u32 (kind, fork, first tick, every, rows, what was asked), then float64, float32."""

from __future__ import annotations

import struct

import numpy as np

from mindlang.view.row_blocks import Doubles, Singles, TickNumbers

HEADER = struct.Struct("<6I")
ROWS_KIND, COLUMNS_KIND = 1, 2
MAX_FRAME_BYTES = 4 << 20
DOUBLE_BYTES, SINGLE_BYTES = 8, 4


def rows_that_fit(doubles: int, singles: int) -> int:
    """How many rows of so many columns a frame can hold, at least one."""
    size = DOUBLE_BYTES * doubles + SINGLE_BYTES * singles
    return max(1, (MAX_FRAME_BYTES - HEADER.size) // max(1, size))


def rows_frame(fork: int, ask: int, first: int, every: int, doubles: Doubles, singles: Singles) -> bytes:
    """Rows: the doubles [rows, columns], row after row, then the singles."""
    header = HEADER.pack(ROWS_KIND, fork, first, every, len(doubles), ask)
    return b"".join((header, doubles.astype("<f8").tobytes(), singles.astype("<f4").tobytes()))


def columns_frame(fork: int, ask: int, first: int, every: int, values: Doubles) -> bytes:
    """Columns `values` [rows, columns], one after the other, all as doubles."""
    header = HEADER.pack(COLUMNS_KIND, fork, first, every, len(values), ask)
    return header + values.astype("<f8").tobytes(order="F")


def unpacked(data: bytes, doubles: int, singles: int) -> tuple[int, int, TickNumbers, Doubles, Singles]:
    """The fork, what was asked, the ticks and both blocks of a frame of rows; ValueError where it is none."""
    if len(data) < HEADER.size or HEADER.unpack_from(data)[0] != ROWS_KIND:
        raise ValueError("this is no frame of rows")
    _, fork, first, every, rows, ask = HEADER.unpack_from(data)
    middle = HEADER.size + DOUBLE_BYTES * doubles * rows
    if len(data) != middle + SINGLE_BYTES * singles * rows:
        raise ValueError(f"a frame of {rows} rows has another length than {len(data)} bytes")
    wide = np.frombuffer(data[HEADER.size : middle], "<f8").reshape(rows, doubles)
    narrow = np.frombuffer(data[middle:], "<f4").reshape(rows, singles)
    return fork, ask, first + every * np.arange(rows), wide, narrow
