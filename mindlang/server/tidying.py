"""A file as `mindc fmt` writes it, as few changed lines as may be: the cursor and all marks stay where they are."""

from collections.abc import Iterator
from itertools import pairwise

from mindlang.compiler.format import formatted
from mindlang.compiler.parse import BLANKS
from mindlang.compiler.source import Source
from mindlang.compiler.splice import Splice

Stretch = tuple[int, int]


def tidied(source: Source) -> list[Splice]:
    """What has to change; lines that cannot be read stay as they are.

    No line comes or goes but for blank ones, so each that says something is held against the one in its place.
    """
    text = formatted(source.text)
    before, after = [*_stretches(source.text)], [*_stretches(text)]
    if len(before) != len(after):
        return [Splice(source, 0, len(source.text), text)]
    pairs = zip(before, after, strict=True)
    return [
        Splice(source, *old, text[slice(*new)]) for old, new in pairs if source.text[slice(*old)] != text[slice(*new)]
    ]


def _stretches(text: str) -> Iterator[Stretch]:
    """From where to where the lines go that say something, and what stands between them."""
    ends, at = [0], 0
    for line in text.split("\n"):
        if line.strip(BLANKS):
            ends += [at, at + len(line)]
        at += len(line) + 1
    return pairwise([*ends, len(text)])
