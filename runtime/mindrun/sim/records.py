"""Rows of tables, by the names of their columns."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Row = Mapping[str, float]


def records(rows: Sequence[Row], columns: Any) -> NDArray[Any]:
    """A table with these columns; what a row does not say is 0."""
    table = np.zeros(len(rows), columns)
    for column in dict.fromkeys(column for row in rows for column in row):
        table[column] = np.fromiter((row.get(column, 0) for row in rows), table.dtype[column], len(rows))
    return table
