"""What differs between two texts, as `patch -p1` and `git apply` take it."""

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator
from difflib import SequenceMatcher
from io import StringIO
from typing import Literal

CONTEXT_LINES = 3  # around a change
MAX_COMPARED_LINES = 100  # that difflib compares; it may take as long as the square of their number
MARGIN_LINES = 100  # lines over which difflib may slide a change that begins or ends as what is beside it

Opcode = tuple[Literal["replace", "delete", "insert", "equal"], int, int, int, int]


def unified(name: str, old: str, new: str) -> str:
    """A unified diff that `patch -p1` and `git apply` take; empty where nothing differs, a new file where `old` is."""
    before, after = (StringIO(text, newline="\n").readlines() for text in (old, new))  # other characters end no line
    # difflib takes long over equal lines, and most lines of an edited file are: it is given those between the first and
    # the last difference alone, with some around them.
    first = _shared_ends(before, after)
    last = _shared_ends(before[first:][::-1], after[first:][::-1])
    start = max(0, first - MARGIN_LINES)
    keep = max(0, last - MARGIN_LINES)
    lines = _hunks(before[start : len(before) - keep], after[start : len(after) - keep], start)
    ended = f"{name}\t" if " " in name else name  # patch takes a blank for the end of a name, unless a tab follows
    heads = [f"--- {f'a/{ended}' if old else '/dev/null'}\n", f"+++ b/{ended}\n"]
    return "".join([*heads, *lines]) if old != new else ""


def _hunks(before: list[str], after: list[str], start: int) -> Iterator[str]:
    """The hunks of a diff, whose lines are counted from `start` on."""
    for group in _Matcher(before, after).get_grouped_opcodes(CONTEXT_LINES):
        (_, i, _, j, _), (_, _, i_end, _, j_end) = group[0], group[-1]
        yield f"@@ -{_counted(i + start, i_end + start)} +{_counted(j + start, j_end + start)} @@\n"
        for tag, i, i_end, j, j_end in group:
            gone, new = ("-", "+") if tag != "equal" else (" ", "")
            yield from (_whole(f"{gone}{line}") for line in before[i:i_end])
            yield from (_whole(f"{new}{line}") for line in after[j:j_end] if new)


class _Matcher(SequenceMatcher[str]):
    """difflib's, which sees of long texts only what lies between lines that stand once in each, in the same order.

    So the time that it takes grows as the texts do.
    """

    def __init__(self, before: list[str], after: list[str]) -> None:
        super().__init__(None, before, after)
        self._texts = before, after

    def get_opcodes(self) -> list[Opcode]:
        """What differs, in stretches that are equal and not."""
        is_short = sum(map(len, self._texts)) <= MAX_COMPARED_LINES
        return super().get_opcodes() if is_short else _merged(_aligned(*self._texts))


def _aligned(before: list[str], after: list[str]) -> Iterator[Opcode]:
    i = j = 0
    for i_next, j_next in [*_anchors(before, after), (len(before), len(after))]:
        if i_next - i + j_next - j > MAX_COMPARED_LINES:
            yield "replace", i, i_next, j, j_next
        else:
            between = SequenceMatcher(None, before[i:i_next], after[j:j_next], autojunk=False).get_opcodes()
            yield from ((tag, i + a, i + b, j + c, j + d) for tag, a, b, c, d in between)
        if i_next < len(before) and j_next < len(after):
            yield "equal", i_next, i_next + 1, j_next, j_next + 1
        i, j = i_next + 1, j_next + 1


def _merged(opcodes: Iterable[Opcode]) -> list[Opcode]:
    """Stretches of one sort that follow one another as one."""
    found: list[Opcode] = []
    for tag, a, b, c, d in opcodes:
        if found and found[-1][0] == tag:
            _, a, _, c, _ = found.pop()
        found.append((tag, a, b, c, d))
    return found


def _anchors(before: list[str], after: list[str]) -> list[tuple[int, int]]:
    """The places of lines that stand once in each text, the longest run of them that is in order in both."""
    once = [{line for line, count in Counter(lines).items() if count == 1} for lines in (before, after)]
    places = {line: place for place, line in enumerate(after) if line in once[1]}
    pairs = [(place, places[line]) for place, line in enumerate(before) if line in once[0] and line in places]
    ends: list[int] = []  # of the runs of each length, the smallest place at which one ends
    last: list[int] = []
    above: list[int] = []
    for number, (_, place) in enumerate(pairs):
        length = bisect_left(ends, place)
        ends[length : length + 1] = [place]
        last[length : length + 1] = [number]
        above.append(last[length - 1] if length else -1)
    run, number = [], last[-1] if last else -1
    while number >= 0:
        run.append(pairs[number])
        number = above[number]
    return run[::-1]


def _shared_ends(before: list[str], after: list[str]) -> int:
    """How many lines two texts have in common at their beginning."""
    pairs = zip(before, after, strict=False)
    return next((index for index, (a, b) in enumerate(pairs) if a != b), min(len(before), len(after)))


def _whole(line: str) -> str:
    """A line of a diff, which says so where the text has no line end there."""
    return line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _counted(start: int, end: int) -> str:
    """Lines as a hunk counts them: from 1 on, how many unless it is one; none stand behind the line before."""
    return f"{start + (end > start)}{'' if end - start == 1 else f',{end - start}'}"
