"""Whole lines of a source: what edits take out and put in, so that comments and line ends stay where they are."""

from collections.abc import Iterable, Sequence

from mindlang.source import Source, Span
from mindlang.splice import Splice
from mindlang.syntax import (
    NOUNS,
    PARTS,
    Contains,
    Counts,
    Declaration,
    Drives,
    Ends,
    Fact,
    File,
    Influences,
    Lasts,
    Reads,
    Rewards,
    Stays,
    Teaches,
    Use,
)

INDENT = "  "
ORDER: tuple[type[Fact], ...] = (Contains, Lasts, Ends, Reads, Drives, Influences, Stays, Rewards, Counts, Teaches)


def instead(span: Span, text: str) -> Splice:
    """Another text for a span."""
    return Splice(span.source, span.start, span.end, text)


def instead_of_line(span: Span, text: str) -> Splice:
    """Another line for that of a span, whose comment goes with it."""
    begin, end = _line(span.source.text, span.start)
    return Splice(span.source, begin, end, text)


def line_of(span: Span) -> str:
    """The whole line of a span, with its comment."""
    begin, end = _line(span.source.text, span.start)
    return span.source.text[begin:end]


def without_line(span: Span) -> Splice:
    """The line of a span taken out, and its comment with it."""
    return _without(span.source, *_line(span.source.text, span.start))


def below(span: Span, lines: Iterable[str]) -> Splice:
    """Lines right below that in which a span ends."""
    return _insert(span.source, _line(span.source.text, span.end)[1], lines)


def below_siblings(declaration: Declaration, form: type[Fact], facts: Iterable[str]) -> Splice:
    """Facts of one verb below the last of that verb, or where it would stand; indented as the others are."""
    earlier = ORDER[: ORDER.index(form) + 1]
    above = [fact for fact in declaration.facts if isinstance(fact, earlier)]
    nearest = max(above, key=lambda fact: (ORDER.index(type(fact)), fact.span.start), default=None)
    indent = indentation(declaration)
    return below(nearest.span if nearest else declaration.header.span, [f"{indent}{fact}" for fact in facts])


def indentation(declaration: Declaration) -> str:
    """What stands before the facts of a declaration."""
    if not declaration.facts:
        return INDENT
    span = declaration.facts[-1].span
    return span.source.text[_line(span.source.text, span.start)[0] : span.start]


def declare(file: File, noun: str, lines: Sequence[str]) -> Splice:
    """A declaration below the last one of its noun, or below that of the noun that comes before it."""
    siblings = [declaration for declaration in file.declarations if declaration.header.noun.text == noun]
    if siblings:
        gap = [] if noun in PARTS and len(lines) == 1 else [""]
        return _insert(file.source, _extent(siblings[-1])[1], [*gap, *lines])
    order = ("body", "actuator", "sensor", "memory", "skill", "task", "curriculum")
    assert set(order) == set(NOUNS)
    before = [d for d in file.declarations if d.header.noun.text in order[: order.index(noun)]]
    if before:
        last = max(before, key=lambda d: (order.index(d.header.noun.text), d.header.span.start))
        return _insert(file.source, _extent(last)[1], ["", *lines])
    if file.settings:
        return _insert(file.source, _line(file.source.text, file.settings[-1].span.end)[1], ["", *lines])
    end = len(file.source.text.rstrip())
    return _insert(file.source, end, ["", *lines] if end else lines)


def declare_below(declaration: Declaration, lines: Sequence[str]) -> Splice:
    """A declaration below another one."""
    return _insert(declaration.header.span.source, _extent(declaration)[1], ["", *lines])


def use_line(file: File, path: str) -> Splice:
    """A line that uses a file, below the last such line, or above all that the file says."""
    line = f'use "{path}"'
    if used := [setting for setting in file.settings if isinstance(setting, Use)]:
        return below(used[-1].span, [line])
    said = [setting.span.start for setting in file.settings]
    said += [declaration.header.span.start for declaration in file.declarations]
    begin = _line(file.source.text, min(said))[0]
    return Splice(file.source, begin, begin, line + newline(file.source))


def without_declaration(declaration: Declaration) -> Splice:
    """A declaration taken out, with the comments that lead it and the blank line that sets it off."""
    source = declaration.header.span.source
    start, end = _extent(declaration)
    before, after = _line_before(source.text, start), _line_after(source.text, end)
    if before and not _said(source.text, before) and _sets_off(declaration, source, after):
        start = before[0]
    return _without(source, start, end)


def text_of(declaration: Declaration) -> str:
    """The text of a declaration with the comments that lead it."""
    start, end = _extent(declaration)
    return declaration.header.span.source.text[start:end]


def newline(source: Source) -> str:
    """How lines end in a source."""
    return "\r\n" if "\r\n" in source.text else "\n"


def _sets_off(declaration: Declaration, source: Source, after: tuple[int, int] | None) -> bool:
    """Whether the blank line above a declaration is its own, and not that of a group of parts that goes on below it."""
    noun = declaration.header.noun.text
    return noun not in PARTS or after is None or source.text[after[0] : after[1]].split()[:1] != [noun]


def _extent(declaration: Declaration) -> tuple[int, int]:
    """From the first comment that leads a declaration to the end of its last line, or of the comment that closes it."""
    header = declaration.header.span
    text = header.source.text
    start = _line(text, header.start)[0]
    while (above := _line_before(text, start)) and _is_comment(text, above) and not _is_closing(text, above):
        start = above[0]
    end = _line(text, max([header.end, *(fact.span.end for fact in declaration.facts)]))[1]
    comments = end
    while (next_ := _line_after(text, comments)) and _is_comment(text, next_):
        comments = next_[1]
        if _is_closing(text, next_):
            end = comments
    return start, comments if next_ is None or not _said(text, next_) else end


def _is_comment(text: str, line: tuple[int, int]) -> bool:
    return text[line[0] : line[1]].lstrip().startswith("#")


def _is_closing(text: str, line: tuple[int, int]) -> bool:
    """Whether a comment is indented, as the facts are to whose declaration it then belongs."""
    return text[line[0]] in " \t"


def _said(text: str, line: tuple[int, int]) -> bool:
    return bool(text[line[0] : line[1]].strip())


def _line(text: str, offset: int) -> tuple[int, int]:
    """Where the line around an offset begins and where it ends, without its line end."""
    begin = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    return begin, end - (end > begin and text[end - 1] == "\r" and end < len(text))


def _line_before(text: str, begin: int) -> tuple[int, int] | None:
    return _line(text, begin - 1) if begin else None


def _line_after(text: str, end: int) -> tuple[int, int] | None:
    start = text.find("\n", end) + 1
    return _line(text, start) if start else None


def _insert(source: Source, end: int, lines: Iterable[str]) -> Splice:
    """Lines below the one that ends at an offset; a source whose last line has no end keeps that."""
    text = newline(source).join(["", *lines]) if end else newline(source).join([*lines, ""])
    return Splice(source, end, end, text)


def _without(source: Source, begin: int, end: int) -> Splice:
    """Whole lines taken out together with the line end before them, or after them where they are the first."""
    if before := _line_before(source.text, begin):
        return Splice(source, before[1], end, "")
    after = _line_after(source.text, end)
    return Splice(source, begin, after[0] if after else end, "")
