"""Edits of a text as splices: nothing else of it changes."""

from collections.abc import Iterable
from dataclasses import dataclass

from mindlang.compiler.source import Source


@dataclass(frozen=True, slots=True)
class Splice:
    """Replaces the characters of a source from offset `start` up to `end` by `text`."""

    source: Source
    start: int
    end: int
    text: str


def spliced(source: Source, splices: Iterable[Splice]) -> str:
    """The text of a source with its own of the splices made; ValueError where two overlap.

    Those that insert at one place stand in their order.
    """
    own = [splice for splice in splices if splice.source is source]
    parts, end = [], 0
    for splice in sorted(own, key=lambda splice: (splice.start, splice.end)):
        if splice.start < end:
            raise ValueError(f"two splices overlap at offset {splice.start} of {source.name}")
        parts += [source.text[end : splice.start], splice.text]
        end = splice.end
    return "".join([*parts, source.text[end:]])
