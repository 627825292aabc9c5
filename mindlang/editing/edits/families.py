"""Edits that make families of lines, and write them out."""

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mindlang.compiler.families import lies_in, numbered
from mindlang.compiler.parse import without_comment
from mindlang.compiler.source import Splice
from mindlang.compiler.syntax import PARTS
from mindlang.editing.insertion import first_line, newline
from mindlang.editing.project import EditError, MindChange, Project

FEWEST_MEMBERS = 3  # lines or declarations that become a family
LETTERS = "NMKLPQRSTUVWXYZ"
_NUMBER = re.compile(r"(?<=[A-Za-z_])(0|[1-9]\d*)(?![A-Za-z0-9])")  # at the end of a name or of a part of it
Lines = list[str]  # of a declaration, or one of a fact


@dataclass(slots=True)
class _Item:
    """A declaration as its lines, and from where to where it stands in the file."""

    lines: Lines
    start: int
    end: int


def fold(project: Project) -> MindChange:
    """Make families of what is written several times.

    Three declarations or facts in a row, or more, become one where they differ in nothing but the number at the end of
    names: Go1, Go2, Go3 become GoN where N is 1 to 3. The mind stays the same, and so does what was learnt.

    Example: mindc edit fold legs.mind
    """
    source, splices = project.main.source, list[Splice]()
    for run in _apart(project):
        inside = [[line for _, line in _folded([[line] for line in item.lines])] for item in run]
        for members, lines in _folded([[line for [line] in lines] for lines in inside]):
            first, last = run[members[0]], run[members[-1]]
            if lines != first.lines:
                splices.append(Splice(source, first.start, last.end, newline(source).join(lines)))
    if not splices:
        message = "No three declarations or facts in a row differ in nothing but the number at the end of names."
        raise EditError(message, "Set those of a family below one another, without comments between.")
    return MindChange(tuple(splices), of_families=True)


def _apart(project: Project) -> Iterator[list[_Item]]:
    """The declarations of the main file in stretches between which something else stands than blank lines."""
    file, run = project.main, list[_Item]()
    text = file.source.text
    for declaration in {each.header.span.start: each for each in file.declarations}.values():
        spans = [declaration.header.span, *(fact.span for fact in declaration.facts)]
        start, end = first_line(spans[0]).start, first_line(max(spans, key=lambda span: span.end)).end
        if any(lies_in(declaration.header.span, family) for family in file.families):
            continue
        if run and text[run[-1].end : start].strip():
            yield run
            run = []
        run.append(_Item(text[start:end].splitlines(), start, end))
    if run:
        yield run


def _folded(items: Sequence[Lines]) -> Iterator[tuple[range, Lines]]:
    """Items of which those in a row that make a family are one, each with the places of its members."""
    place = 0
    while place < len(items):
        count = _count(items[place:])
        count = count if count >= FEWEST_MEMBERS else 1
        lines = _family(items[place], items[place + 1], count) if count > 1 else items[place]
        yield range(place, place + count), lines
        place += count


def _count(items: Sequence[Lines]) -> int:
    """How many items from the first on differ in nothing but a number, one more from each to the next."""
    if len(items) < FEWEST_MEMBERS or not (wanted := _growing(items[0], items[1])):
        return 1
    first = _numbers(items[0])
    count = 1
    for number, item in enumerate(items[1:], 1):
        is_bare = all(without_comment(line) == line for line in item)
        numbers = [each + number * (place in wanted) for place, each in enumerate(first)]
        if not is_bare or _skeleton(item) != _skeleton(items[0]) or _numbers(item) != numbers:
            break
        count += 1
    return count


def _growing(first: Lines, second: Lines) -> set[int]:
    """The places of the numbers that are one more in the second; none where they differ otherwise, or in no name."""
    pairs = list(zip(_numbers(first), _numbers(second), strict=False))
    grown = {place for place, (one, other) in enumerate(pairs) if one != other}
    steps = {pairs[place] for place in grown}
    is_one = len(steps) == 1 and all(other == one + 1 for one, other in steps)
    return grown if is_one and min(grown) < len(_numbers(first[:1])) else set()


def _family(first: Lines, second: Lines, count: int) -> Lines:
    """The lines of a family whose first members these are."""
    grown, places, codes = _growing(first, second), itertools.count(), [without_comment(line) for line in first]
    number = _numbers(first)[min(grown)]
    letter = next(each for each in LETTERS if not re.search(rf"(?<=\w){each}(?![A-Za-z0-9])", "\n".join(codes)))
    written = [_NUMBER.sub(lambda found: letter if next(places) in grown else found[0], code) for code in codes]
    written[0] = f"{written[0].rstrip()} where {letter} is {number} to {number + count - 1}"
    comments = (line[len(code) :] for line, code in zip(first, codes, strict=True))
    return ["  ".join(filter(None, (code.rstrip(), comment))) for code, comment in zip(written, comments, strict=True)]


def _numbers(lines: Lines) -> list[int]:
    return [int(found) for found in _NUMBER.findall("\n".join(map(without_comment, lines)))]


def _skeleton(lines: Lines) -> str:
    codes = (" ".join(without_comment(line).split()) for line in lines)
    return _NUMBER.sub("0", "\n".join(filter(None, codes)))


_CLAUSE = re.compile(r"\s+where\s+([A-Z])\s+is\s+(\d+)\s+to\s+(\d+)\s*$")


def unfold(project: Project) -> MindChange:
    """Write out families: a declaration or a line for each member.

    The mind stays the same. It is the reverse of fold.

    Example: mindc edit unfold legs.mind
    """
    families = project.main.families
    if not families:
        raise EditError("No line of this file stands for several.", "A family says where N is 1 to 10.")
    splices = []
    for family in families:
        if not any(lies_in(family, other) for other in families if other is not family):
            start, end = first_line(family).start, max(family.end, first_line(family).end)
            lines = family.source.text[start:end].splitlines()
            splices.append(Splice(family.source, start, end, newline(family.source).join(_unfolded(lines))))
    return MindChange(tuple(splices), of_families=True)


def _unfolded(lines: list[str]) -> list[str]:
    """The lines of a family written out; comments stay with the first member."""
    code = without_comment(lines[0])
    below = [each for line in lines[1:] for each in _unfolded([line])]
    clause = _CLAUSE.search(code)
    if not clause:
        return [lines[0], *below]
    letter, first, last = clause[1], int(clause[2]), int(clause[3])
    head, comment = code[: clause.start()], lines[0][len(code) :]
    found = [numbered(line, letter, first) for line in ("  ".join(filter(None, (head, comment))), *below)]
    gap = [""] if below and code.split()[0] not in PARTS else []
    bare = [line for line in (without_comment(each).rstrip() for each in (head, *below)) if line]
    for number in range(first + 1, last + 1):
        found += [*gap, *(numbered(line, letter, number) for line in bare)]
    return found
