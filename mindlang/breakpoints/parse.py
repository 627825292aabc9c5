"""Text of a .break file → its lines; a bad one is reported and left out, and every other one is read."""

from functools import cache
from typing import TYPE_CHECKING, Any, cast

from lark import v_args

from mindlang.breakpoints.mistakes import explain
from mindlang.breakpoints.syntax import Line, Moment, Transmits
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import coded_lines, has_too_many_mistakes, is_too_deep
from mindlang.compiler.parse.build import Builder
from mindlang.compiler.parse.shape import read_grammar
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import Amount, Ends, Phrase, When

if TYPE_CHECKING:
    from lark import Lark


def parse(source: Source, findings: Findings) -> list[Line]:
    """The lines that can be read; the others are reported."""
    from lark import UnexpectedInput

    found: list[Line] = []
    for span, code in coded_lines(source):
        if has_too_many_mistakes(span, "Is this a .break file?", findings):
            break
        if is_too_deep(span, code, findings):
            continue
        try:
            found.append(parse_line(code, source, span.start))
        except UnexpectedInput as error:
            findings.diagnostics.append(explain(error, code, span))
    return found


def parse_line(code: str, source: Source, offset: int) -> Line:
    """What the line `code` says that stands at `offset` of a source; lark.UnexpectedInput where it says nothing."""
    return cast(Line, _Builder(source, offset).transform(grammar().parse(code, start="line")))


@cache
def grammar() -> "Lark":
    """The grammar of one line."""
    return read_grammar("break.lark", "line")


@v_args(meta=True)
class _Builder(Builder):
    """What the rules become that a .break file has beside those of the language."""

    def line(self, meta: Any, parts: list[Any]) -> Line:
        span = self._span(meta)
        match parts[0]:
            case When() as when:
                return Ends(None, None, when, span)
            case Amount() as tick:
                return Moment(tick, span)
        *times, event = parts[0]
        return Ends(times[0] if times else None, event, None, span)

    def happening(self, meta: Any, parts: list[Any]) -> list[Amount | Phrase]:
        return parts

    def moment(self, meta: Any, parts: list[Any]) -> Amount:
        return cast(Amount, parts[0])

    def transmission(self, meta: Any, parts: list[Any]) -> Transmits:
        skill, to, level, amount = parts
        return Transmits(self._name(skill), self._name(to), str(level), amount, self._span(meta))
