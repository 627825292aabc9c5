"""Edits of a text as splices: nothing else of it changes."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from difflib import unified_diff
from io import StringIO

from mindlang.source import Source

CONTEXT = 3  # lines around a change in a diff
MARGIN = 100  # lines over which difflib may slide a change that begins or ends as what is beside it


@dataclass(frozen=True, slots=True)
class Splice:
    """In a source, instead of the characters from offset `start` up to `end`, stands `text`."""

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


def unified(name: str, old: str, new: str) -> str:
    """A unified diff that `patch -p1` and `git apply` take; empty where nothing differs, a new file where `old` is."""
    before, after = (StringIO(text, newline="\n").readlines() for text in (old, new))  # other characters end no line
    # difflib takes long over equal lines, and most lines of an edited file are: it is given those between the first and
    # the last difference alone, with some around them.
    first = _common(before, after)
    last = _common(before[first:][::-1], after[first:][::-1])
    start = max(0, first - MARGIN)
    keep = max(0, last - MARGIN)
    lines = unified_diff(before[start : len(before) - keep], after[start : len(after) - keep], n=CONTEXT)
    ended = f"{name}\t" if " " in name else name  # patch takes a blank for the end of a name, unless a tab follows
    return "".join(_named(f"a/{ended}" if old else "/dev/null", f"b/{ended}", lines, start))


def _common(before: list[str], after: list[str]) -> int:
    """How many lines two texts have in common at their beginning."""
    pairs = zip(before, after, strict=False)
    return next((index for index, (a, b) in enumerate(pairs) if a != b), min(len(before), len(after)))


def _named(old: str, new: str, lines: Iterable[str], start: int) -> Iterator[str]:
    """The lines of a diff with the names of its files, and line numbers that count from the file's first line."""
    for number, line in enumerate(lines):
        match number, line:
            case 0, _:
                yield f"--- {old}\n"
            case 1, _:
                yield f"+++ {new}\n"
            case _ if line.startswith("@@"):
                yield _moved(line, start)
            case _:
                yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _moved(hunk: str, by: int) -> str:
    """`@@ -1,4 +1,5 @@` that counts its lines from `by` lines earlier."""
    marks, old, new, end = hunk.split(" ", 3)
    return " ".join([marks, *(_counted(place, by) for place in (old, new)), end])


def _counted(place: str, by: int) -> str:
    line, comma, count = place[1:].partition(",")
    return f"{place[0]}{int(line) + by}{comma}{count}"
