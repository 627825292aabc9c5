"""JSON that comes from outside: whoever wrote it, reading it ends in a value or in one error with words."""

import json
from collections import Counter
from math import isfinite
from typing import Any, NoReturn


def parsed(data: bytes | str, most: int = 1 << 20) -> Any:
    """The value of a JSON text; ValueError where it is none, longer than `most`, nested too deep, or not finite.

    A name that stands twice in a table is an error, too: which of its values holds, readers would not agree on.
    """
    if len(data) > most:
        raise ValueError(f"it is larger than {most / (1 << 20):g} MiB")
    try:
        return json.loads(data, parse_float=_finite, parse_constant=_no_number, object_pairs_hook=_table)
    except RecursionError as error:
        raise ValueError("it is nested too deep") from error


def is_whole(value: object, low: int = 0, high: int = (1 << 53) - 1) -> bool:
    """True if a value is a whole number, no bool, within these bounds."""
    return type(value) is int and low <= value <= high


def are_names(value: object) -> bool:
    """True if a value is a list of texts, no two the same, that a terminal can show."""
    return (
        isinstance(value, list)
        and all(isinstance(name, str) and name.isprintable() for name in value)
        and len(set(value)) == len(value)
    )


def _table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        twice = Counter(name for name, _ in pairs).most_common(1)[0][0]
        raise ValueError(f"{twice:.40} stands there twice")
    return table


def _finite(text: str) -> float:
    if not isfinite(value := float(text)):
        _no_number(text)
    return value


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text:.40} is no number")
