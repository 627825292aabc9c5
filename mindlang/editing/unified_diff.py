"""A unified diff of two texts, as `patch -p1` and `git apply` take it."""

from collections.abc import Iterator
from difflib import SequenceMatcher
from io import StringIO

CONTEXT_LINES = 3  # around a change
LEADING_LINES, TRAILING_LINES = (
    30,
    6,
)  # that are compared around all changes: what may slide slides down, and has context
MAX_COMPARED_LINES = 6000  # of both texts between their ends: difflib takes up to the square of their number


def unified(name: str, old: str, new: str) -> str:
    """A unified diff, empty where nothing differs and that of a new file where `old` is empty.

    Where more than MAX_COMPARED_LINES lie between the first and the last difference, they are one change.
    """
    if old == new:
        return ""
    before, after = (StringIO(text, newline="\n").readlines() for text in (old, new))  # other characters end no line
    ended = f"{name}\t" if " " in name else name  # patch takes a blank for the end of a name, unless a tab follows
    heads = [f"--- {f'a/{ended}' if old else '/dev/null'}\n", f"+++ b/{ended}\n"]
    return "".join([*heads, *_hunks(before, after)])


def _hunks(before: list[str], after: list[str]) -> Iterator[str]:
    """The lines of each hunk, compared without what both texts begin and end with but for its context."""
    head = _common(before, after)
    tail = _common(before[head:][::-1], after[head:][::-1])
    first, last = max(0, head - LEADING_LINES), max(0, tail - TRAILING_LINES)
    a, b = before[first : len(before) - last], after[first : len(after) - last]
    above, ends = head - first, (len(a) - tail + last, len(b) - tail + last)
    if len(a) + len(b) <= MAX_COMPARED_LINES:
        groups = [*SequenceMatcher(None, a, b).get_grouped_opcodes(CONTEXT_LINES)]
    else:
        changed = ("replace", above, ends[0], above, ends[1])
        begin = max(0, above - CONTEXT_LINES)
        below = min(len(a), ends[0] + CONTEXT_LINES), min(len(b), ends[1] + CONTEXT_LINES)
        groups = [[("equal", begin, above, begin, above), changed, ("equal", ends[0], below[0], ends[1], below[1])]]
    for group in groups:
        (_, i, _, j, _), (_, _, i_end, _, j_end) = group[0], group[-1]
        yield f"@@ -{_counted(i + first, i_end + first)} +{_counted(j + first, j_end + first)} @@\n"
        for tag, i, i_end, j, j_end in group:
            yield from (_whole(f"{' ' if tag == 'equal' else '-'}{line}") for line in a[i:i_end])
            yield from (_whole(f"+{line}") for line in b[j:j_end] if tag != "equal")


def _common(before: list[str], after: list[str]) -> int:
    """The number of lines with which both texts begin."""
    pairs = enumerate(zip(before, after, strict=False))
    return next((place for place, (a, b) in pairs if a != b), min(len(before), len(after)))


def _whole(line: str) -> str:
    """A line of a diff, which says so where the text has no line end there."""
    return line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _counted(start: int, end: int) -> str:
    """Lines as a hunk counts them: from 1 on, how many unless it is one; none stand behind the line before."""
    return f"{start + (end > start)}{'' if end - start == 1 else f',{end - start}'}"
