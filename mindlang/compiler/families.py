"""Families: a line that stands for several, `skill GoN is mlp where N is 1 to 10`, written out as Go1 … Go10.

A member is a declaration or a fact as any other; its names have the places of those in the line of the family. The
letter stands for a number where it ends a name or a part of it: in `legN_hip` and `GoN`, not in `Nest` or `GoNow`.
In `reading N of wanted` it is the number.
"""

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace as with_fields
from typing import Any, TypeVar

from msgspec.structs import replace

from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Amount, Family, Name, rebuilt, walk_tree

MOST_MEMBERS, MOST_LINES = 1000, 20_000  # of one family
_LETTER = re.compile(r"(?<=\w)[A-Z](?![A-Za-z0-9])")

L = TypeVar("L")


def members(named: Any, family: Family, lines: int, findings: Findings) -> range:
    """The numbers of a family, empty after reporting what is wrong with it.

    The letter has to stand in `named`, the name of a declaration or a fact; `lines` is how many each member has.
    """
    letter = family.letter
    if not re.fullmatch("[A-Z]", letter.text):
        hint = "Write one, as in skill GoN is mlp where N is 1 to 10."
        findings.error("family-letter", letter.span, "A family is numbered by one capital letter.", hint)
    elif wrong := _wrong_numbers(family.first, family.last, lines):
        hint = f"Write two whole numbers, the smaller one first: where {letter.text} is 1 to 10."
        findings.error("family-numbers", family.span, wrong, hint)
    elif not any(isinstance(node, Name) and member(node, letter.text, 0) != node for node in walk_tree(named)):
        message, hint = f"No name here ends in {letter.text}.", f"Write for example Go{letter.text}."
        findings.error("family-letter", letter.span, message, hint)
    else:
        return range(int(family.first.number), int(family.last.number) + 1)
    return range(0)


def _wrong_numbers(first: Amount, last: Amount, lines: int) -> str:
    """A sentence about numbers that a family cannot have; empty where it can."""
    if not all(amount.span.text.isdecimal() for amount in (first, last)):
        return "The members of a family have whole numbers."
    if last.number < first.number:
        return "This family has no members."
    if not last.number - first.number <= sys.maxsize:  # also of numbers that are no longer any
        return f"This family has too many members: {MOST_MEMBERS} is the most."
    count = int(last.number - first.number) + 1
    if count > MOST_MEMBERS:
        return f"This family has {count} members, and {MOST_MEMBERS} is the most."
    return (
        f"Written out, it has {count * lines} lines, and {MOST_LINES} is the most."
        if count * lines > MOST_LINES
        else ""
    )


def letter_in(name: str) -> str:
    """The letter that stands for a number in a name; empty where none does."""
    found = _LETTER.search(name)
    return found[0] if found else ""


def numbered(text: str, letter: str, number: int | str) -> str:
    """A text with a number, or another letter, in the place of the letter."""
    before = r"(\w|\b(?:reading|observation|action|choice)\s+)"
    return re.sub(rf"{before}{letter}(?![A-Za-z0-9])", rf"\g<1>{number}", text)


def member(line: L, letter: str, number: int) -> L:
    """A line or a declaration with a number in the place of the letter."""

    def changed(node: Any) -> Any:
        match node:
            case Name(text) if letter in text:
                return replace(node, text=numbered(text, letter, number))
            case Amount(name=name) if name == letter:
                return replace(node, number=float(number), name="")
        return node

    found: L = rebuilt(line, changed)
    return found


def is_of_family(name: Name) -> bool:
    """True if a name is that of a member, and its place has that of the family."""
    written, own = name.span.text, name.text.removeprefix(f"{name.span.source.alias}.")
    return bool(_LETTER.search(written)) and bool(re.fullmatch(_LETTER.sub(r"\\w+", re.escape(written)), own))


def said(node: Any) -> str:
    """The text of a part of a tree, as it is written; of a member with its own names."""
    span: Span = node.span
    text = span.text
    if not _LETTER.search(text):
        return text
    names = {each.span.start: each for each in walk_tree(node) if isinstance(each, Name) and is_of_family(each)}
    for start in sorted(names, reverse=True):
        own = names[start].text.removeprefix(f"{span.source.alias}.")
        text = text[: start - span.start] + own + text[names[start].span.end - span.start :]
    return text


def each_family_once(found: Iterable[Diagnostic], families: Sequence[Span]) -> Iterator[Diagnostic]:
    """Diagnostics, of those of several members in one place the first, without a fix, which would be one of all."""
    same: dict[tuple[object, ...], list[Diagnostic]] = {}
    for number, each in enumerate(found):
        span = each.span
        is_shared = span is not None and any(lies_in(span, family) for family in families)
        key: tuple[object, ...] = (each.code, span.source, span.start, span.end) if span and is_shared else (number,)
        same.setdefault(key, []).append(each)
    for key, (first, *others) in same.items():
        told = f" So it is with {len(others)} more of its family." if others else ""
        yield first if len(key) == 1 else with_fields(first, message=f"{first.message}{told}", fix=None)


def lies_in(span: Span, family: Span) -> bool:
    """True if a span lies in the lines of a family."""
    return span.source is family.source and family.start <= span.start and span.end <= family.end
