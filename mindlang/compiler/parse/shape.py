"""Parses lines quickly: Lark parses each shape of line once; lines that differ in names and numbers alone share it.

The shape of a line is its text with `a` for every name, `A` for every title and `1` for every number. Where words begin
and end, and of what sort they are, is all that the grammar asks of them: lines of one shape have the same tree.
"""

import re
import sys
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

from mindrun.files.user_cache import user_cache
from msgspec import Struct
from msgspec.structs import astuple

from mindlang.compiler import syntax
from mindlang.compiler.source import Source, Span

if TYPE_CHECKING:  # a command that only shows what rules say reads no mind
    from lark import Lark

_PIECE = re.compile(r"(?<!\w)[0-9]+|\w+|[ \t]+|\W")
MAX_SHAPES = 4096  # of a line that are remembered; a file has some dozens


Maker = Callable[[Source, Sequence[int]], Any]  # of a line in a source, and where each of its pieces begins and it ends
Start = Literal["line", "stop"]  # a rule of the grammar: a line of a mind or of a .break file


@cache
def grammar() -> "Lark":
    """The grammar, with `start` for a whole file, `line` for one line and `stop` for one of a .break file."""
    return read_grammar(_table_file())


def read_grammar(table: str | bool) -> "Lark":
    """The grammar read by Lark, or from the cached `table`, which has only the rules that the parser uses."""
    from lark import Lark

    here = Path(__file__).parents[2]
    folder = next(folder for folder in (here / "grammar", here.parent / "grammar") if folder.is_dir())
    starts = ["start", "line", "stop"]
    return Lark.open(
        str(folder / "mind.lark"),
        parser="lalr",
        start=starts,
        propagate_positions=True,
        maybe_placeholders=False,
        cache=table,
    )


def _table_file() -> str | bool:
    """Where Lark keeps its table, which takes six times as long to make as to read; False for nowhere."""
    try:
        folder = user_cache()
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return False
    return str(folder / f"mind.lark.{sys.implementation.cache_tag}.table")


def parse_line(code: str, source: Source, offset: int, start: Start = "line") -> syntax.Line | syntax.Stop:
    """The syntax of a line without comment, which stands at `offset` of a source.

    lark.UnexpectedInput where it has none; the error is about `code`.
    """
    maker = None if '"' in code else _maker(shape_of(code), start)
    if maker is None:
        return _parsed(code, source, offset, start)
    at = tuple(accumulate(map(len, pieces(code)), initial=offset))
    return cast(syntax.Line | syntax.Stop, maker(source, at))


def pieces(code: str) -> list[str]:
    """A line cut where words, numbers, blanks and signs begin."""
    return _PIECE.findall(code)


def shape_of(code: str) -> str:
    """The shape of a line, piece by piece; of lines without quotes."""
    return "".join(map(_stands_for, pieces(code)))


def _stands_for(piece: str) -> str:
    """The placeholder of a piece of a line in its shape."""
    first = piece[0]
    if "a" <= first <= "z":
        return piece if piece in _words() else "a"
    if "A" <= first <= "Z":
        return "A"
    if "0" <= first <= "9":
        return "1"
    return " " if first in " \t" else piece


@cache
def _words() -> frozenset[str]:
    """Every word that the grammar knows."""
    return frozenset(word for terminal in grammar().terminals for word in re.findall(r"\w+", terminal.pattern.value))


def _parsed(code: str, source: Source, offset: int, start: Start) -> syntax.Line | syntax.Stop:
    from mindlang.compiler.parse.build import build_line

    return build_line(grammar().parse(code, start=start), source, offset)


@lru_cache(MAX_SHAPES)
def _maker(shape: str, start: Start) -> Maker | None:
    """A function that builds the syntax of any line of a shape; None where Lark cannot read the shape."""
    from lark import UnexpectedInput

    try:
        line = _parsed(shape, Source("shape", shape), 0, start)
    except UnexpectedInput:
        return None
    at = accumulate(map(len, pieces(shape)), initial=0)
    return _making(line, {start: place for place, start in enumerate(at)})


def _making(node: Any, places: dict[int, int]) -> Maker:
    """A function that builds this node for other lines of its shape; `places`: number of each piece by its offset."""
    match node:
        case Span(_, start, end):
            return _spanning(places[start], places[end])
        case syntax.Name(text, span):
            spanned = _spanning(places[span.start], places[span.end])
            if text != span.text or " " in text:  # `its  reward`, or an argument that goes without saying
                return lambda source, at: syntax.Name(text, spanned(source, at))
            return lambda source, at: syntax.Name((its := spanned(source, at)).text, its)
        case syntax.Amount(sign, _, span, name=name) if name:
            spanned = _spanning(places[span.start], places[span.end])
            return lambda source, at: syntax.Amount(
                sign, "", (its := spanned(source, at)), name=its.text.lstrip("+- \t")
            )
        case syntax.Amount(_, unit, span, per):
            from mindlang.compiler.parse.build import parse_number

            spanned = _spanning(places[span.start], places[span.end])
            return lambda source, at: syntax.Amount(parse_number((its := spanned(source, at)).text), unit, its, per)
        case tuple():
            makers = [_making(part, places) for part in node]
            return lambda source, at: tuple([make(source, at) for make in makers])
        case Struct():
            cls, parts = type(node), [_making(part, places) for part in astuple(node)]
            return lambda source, at: cls(*[make(source, at) for make in parts])
    return lambda source, at: node


def _spanning(first: int, end: int) -> Callable[[Source, Sequence[int]], Span]:
    return lambda source, at: Span(source, at[first], at[end])
