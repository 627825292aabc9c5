"""Tables as columns by name, and as CSV for spreadsheets and notebooks."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Column = NDArray[Any]
SLICE_ROWS = 10_000  # rows whose texts are in memory at a time


def columns(named: Iterable[tuple[str, Column]]) -> dict[str, Column]:
    """The columns by name; a name that several have is numbered, from 1 on."""
    pairs = list(named)
    times = Counter(name for name, _ in pairs)
    seen: Counter[str] = Counter()
    table = {}
    for name, column in pairs:
        seen[name] += 1
        table[f"{name} {seen[name]}" if times[name] > 1 else name] = column
    return table


def csv_bytes(table: Mapping[str, Column]) -> bytes:
    """The table as CSV: a line of names, and one for each row."""
    return b"".join(csv_parts(table))


def csv_parts(table: Mapping[str, Column]) -> Iterator[bytes]:
    """The same part after part, so that not all of a long table is in memory as text."""
    yield (",".join(map(_quoted, table)) + "\n").encode()
    for begin in range(0, max(map(len, table.values())), SLICE_ROWS):
        texts = [_texts(column[begin : begin + SLICE_ROWS]) for column in table.values()]
        yield "\n".join([*map(",".join, zip(*texts, strict=True)), ""]).encode()


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"' if set(name) & set('",\n\r') else name


def _texts(column: Column) -> list[str]:
    """Each number with the fewest digits that give it back; nothing where it is not finite."""
    if column.dtype.kind in "US":
        return list(map(_quoted, column.tolist()))
    if column.dtype == np.float32:
        texts = [repr(float(text)) if "e" in text else text for text in map(str, column)]  # 1e6 is no 1e+06
    else:
        texts = list(map(repr, column.tolist()))
    for row in np.flatnonzero(~np.isfinite(column)):
        texts[row] = ""
    return texts
