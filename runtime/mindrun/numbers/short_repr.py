"""Short reprs for notebooks: a value's type and fields in one line, however much it has."""

from collections.abc import Collection
from dataclasses import fields
from pathlib import Path
from typing import Any

MOST_CHARACTERS, TEXT_CHARACTERS = 160, 40  # of all, and of a text in it


class ShortRepr:
    """A dataclass with `repr=False` whose repr is a line: texts cut, arrays by their shape, other things by number."""

    __slots__ = ()

    def __repr__(self) -> str:
        line = _called(self, _part)
        return line if len(line) <= MOST_CHARACTERS else f"{line[: MOST_CHARACTERS - 2]}…)"


def full_repr(of: Any) -> str:
    """The usual repr of a dataclass that is a ShortRepr, with all that is in it."""
    return _called(of, repr)


def _called(of: Any, part: Any) -> str:
    said = ", ".join(f"{field.name}={part(getattr(of, field.name))}" for field in fields(of) if field.repr)
    return f"{type(of).__qualname__}({said})"


def _part(value: Any) -> str:
    match value:
        case None | bool() | int() | float():
            return repr(value)
        case str() | Path():
            text = str(value)
            return repr(text if len(text) <= TEXT_CHARACTERS else f"{text[: TEXT_CHARACTERS - 1]}…")
    if hasattr(value, "dtype"):
        return f"{value.dtype}{[*value.shape]}"
    return f"[{len(value)}]" if isinstance(value, Collection) else type(value).__name__
