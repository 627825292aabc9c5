"""The syntax tree from its root down to an offset."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from mindlang.compiler.source import Span
from mindlang.compiler.syntax import File


def path_to(file: File, offset: int) -> list[Any]:
    """The nodes that hold an offset, each inside the one before; a declaration holds what stands in it."""
    path: list[Any] = []
    nodes: Iterator[Any] = iter((*file.settings, *file.declarations))
    while (found := next((node for node in nodes if _holds(node, offset)), None)) is not None:
        path.append(found)
        nodes = _parts(found)
    return path


def _parts(node: Any) -> Iterator[Any]:
    for field in fields(node):
        value = getattr(node, field.name)
        yield from (part for part in (value if isinstance(value, tuple) else (value,)) if _is_node(part))


def _is_node(value: Any) -> bool:
    return is_dataclass(value) and not isinstance(value, Span)


def _holds(node: Any, offset: int) -> bool:
    span = getattr(node, "span", None)
    if span is None:
        return any(_holds(part, offset) for part in _parts(node))
    return bool(span.start <= offset <= span.end)
