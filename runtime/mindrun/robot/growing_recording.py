"""A recording while it is written: its bytes as they come, however they are cut, and the rows that are whole."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from mindrun.graph.recording_header import MAX_HEADER_BYTES, About, RecordingError, about_of_line
from mindrun.robot.recording import whole_rows

MAX_EMPTY_PARTS = 20  # in a row, before there is a first line


def read_growing(path: Path, parts: Iterator[bytes]) -> tuple[About, Iterator[NDArray[Any]]]:
    """What a recording is of, and its rows as they come: no row for a part with none, as an empty one.

    RecordingError where it is no recording; from the rows, where one is damaged, behind all that are before it. A last
    row that is not whole waits for the rest of it. `path` is what messages call it.
    """
    line, waiting = _first_line(path, parts)
    about = about_of_line(line, path)
    return about, whole_rows(path, about, chain([waiting], parts))


def _first_line(path: Path, parts: Iterator[bytes]) -> tuple[bytes, bytes]:
    """The first line, and what has come behind it."""
    waiting, empty, end = bytearray(), 0, -1
    for part in parts:
        empty = 0 if part else empty + 1
        before = len(waiting)
        waiting += part
        end = waiting.find(b"\n", before)
        if end >= 0 or len(waiting) >= MAX_HEADER_BYTES:
            break
        if empty == MAX_EMPTY_PARTS:
            raise RecordingError(f"{path} has no first line yet", "is it still written?")
    end = min(end + 1 if end >= 0 else len(waiting), MAX_HEADER_BYTES)
    return bytes(waiting[:end]), bytes(waiting[end:])
