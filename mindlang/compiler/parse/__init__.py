"""Text → File, line by line: a bad line is reported and left out, and every other one is read."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

from mindrun.errors import nearest
from msgspec import structs

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.families import member, members
from mindlang.compiler.parse.explain import explain, proper
from mindlang.compiler.parse.shape import Start, parse_line
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import NOUNS, SETTINGS, VERBS

MAX_NESTING = 64
MAX_UNREADABLE_LINES = 1000  # unreadable lines, after which this is no mind

BLANKS = " \t\r"  # at the end of a line, and of its code where a comment follows

KNOWN = (*NOUNS, *VERBS, *SETTINGS)

_CODE = re.compile(r'(?:"[^"]*"|[^#])*')
_HEADER = re.compile(r"\s*(\w+)\s+(\w[\w.+]*)")


@dataclass(slots=True)
class _Block:
    """A header, perhaps that of a family, and the lines below it; None is a line that cannot be read."""

    header: syntax.Header | None
    family: syntax.Family | None
    facts: list[syntax.Fact | None] = field(default_factory=list)

    @property
    def span(self) -> Span:
        """The lines from the header to the last fact, of a block that has a header."""
        assert self.header
        start, text = self.header.span, self.header.span.source.text
        last = max([start.end, *(fact.span.end for fact in self.facts if fact)])
        end = (text.find("\n", last) + 1 or len(text) + 1) - 1
        return replace(start, end=end - text.endswith("\r", 0, end))

    def add(self, line: syntax.Fact | None, family: syntax.Family | None, findings: Findings) -> None:
        """Add a fact, or those of a family."""
        if line is None or family is None:
            self.facts.append(line)
        elif numbers := members(line, family, 1, findings):
            self.facts += [member(line, family.letter.text, number) for number in numbers]
        else:
            self.facts.append(None)

    def declarations(self, findings: Findings) -> Iterator[syntax.Declaration]:
        """The declaration, or those of a family; none where the header cannot be read."""
        if self.header is None:
            return
        declaration = syntax.Declaration(self.header, tuple(filter(None, self.facts)), None not in self.facts)
        if self.family is None:
            yield declaration
        elif numbers := members(self.header.name, self.family, 1 + len(self.facts), findings):
            yield from (member(declaration, self.family.letter.text, number) for number in numbers)
        else:
            yield structs.replace(declaration, facts=(), whole=False)


def parse(source: Source, findings: Findings) -> syntax.File:
    """The file as far as its lines can be read; the others are reported."""
    settings: list[syntax.Setting] = []
    blocks: list[_Block] = []
    families: list[Span] = []
    is_below_header = False
    for read in _lines(source, findings):
        line, family = (read.line, read.family) if isinstance(read, syntax.Repeated) else (read, None)
        if isinstance(line, syntax.Setting):
            settings.append(line)
            is_below_header = False
        elif isinstance(line, syntax.Header) or not (line or is_below_header):  # what cannot be read may be a header
            blocks.append(_Block(line if isinstance(line, syntax.Header) else None, family))
            is_below_header = True
        elif is_below_header:
            blocks[-1].add(line, family, findings)
            families += [read.span] if read and family else []
        else:
            hint = "A fact stands below the skill, task or curriculum to which it belongs."
            findings.error("homeless-fact", line.span, "This fact belongs to no declaration.", hint)
    families += [each.span for each in blocks if each.family]
    declarations = (declaration for block in blocks for declaration in block.declarations(findings))
    return syntax.File(source, tuple(settings), tuple(declarations), tuple(families))


def parse_stops(source: Source, findings: Findings) -> list[syntax.Stop]:
    """The lines of a .break file as far as they can be read; the others are reported."""
    return [line for line in _lines(source, findings, "stop") if isinstance(line, syntax.Stop)]


def without_comment(line: str) -> str:
    """The part of a line before its comment."""
    found = _CODE.match(line)
    return found[0] if found else ""


def _lines(source: Source, findings: Findings, start: Start = "line") -> Iterator[Any]:
    """The lines that are more than a comment, each without it and without the blanks before it; None is unreadable."""
    offset = 0
    for text in source.text.split("\n"):
        if code := without_comment(text).rstrip(BLANKS):
            span = Span(source, offset, offset + len(code))
            if len(findings.diagnostics) > MAX_UNREADABLE_LINES:
                hint = f"Is this a {'.mind' if start == 'line' else '.break'} file?"
                findings.error("too-many-mistakes", span, "Too many lines cannot be read; this is where I stop.", hint)
                return
            yield _line(span, code, findings, start)
        offset += len(text) + 1


def _line(span: Span, code: str, findings: Findings, start: Start) -> syntax.Line | syntax.Stop | None:
    """The syntax of a line; of one that is wrong, after reporting it, its header, if that can be saved."""
    from lark import UnexpectedInput

    if code.count("(") + code.count("-") > MAX_NESTING and _depth(code) > MAX_NESTING:
        hint = f"At most {MAX_NESTING} parentheses and signs may stand inside one another."
        findings.error("nested-too-deep", span, "This expression is nested too deep.", hint)
        return None
    try:
        return parse_line(code, span.source, span.start, start)
    except UnexpectedInput as error:
        findings.diagnostics.append(explain(error, code, span, start))
        return _saved(code, span)


def _saved(code: str, span: Span) -> syntax.Header | None:
    """The header that a malformed line was meant to be, so that its facts have a home; None where it was none."""
    found = _HEADER.match(code)
    noun = _meant(found[1]) if found else None
    if not found or noun not in NOUNS:
        return None
    nouns, names = (Span(span.source, span.start + found.start(i), span.start + found.end(i)) for i in (1, 2))
    return syntax.Header(syntax.Name(noun, nouns), syntax.Name(proper(noun, found[2]), names), None, span)


@lru_cache(1024)
def _meant(word: str) -> str | None:
    """The known word nearest to a line's first; `scene` only if written so: much else is near it, as in `seek`."""
    return word if word == "scene" else nearest(word, [known for known in KNOWN if known != "scene"])


def _depth(code: str) -> int:
    """How many parentheses and signs stand inside one another at most."""
    deepest = open_ = signs = 0
    for character in code:
        match character:
            case "(":
                open_ += 1
            case ")":
                open_ -= 1
            case "-":
                signs += 1
            case " " | "\t":
                continue
            case _:
                signs = 0
        deepest = max(deepest, open_ + signs)
    return deepest
