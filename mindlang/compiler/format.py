"""The one way in which a file is written: spaces and blank lines are set, nothing else is touched.

Facts stand two spaces in, words one space apart, comments two spaces after what they follow. What owns facts is set off
by a blank line. Nothing is reordered or aligned, and no comment changes.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, pairwise

from mindlang.compiler.parse import BLANKS, without_comment
from mindlang.compiler.parse.shape import MAX_SHAPES, Start, grammar, pieces, shape_of
from mindlang.compiler.source import Source, Splice
from mindlang.compiler.syntax import NOUNS, SETTINGS, VERBS_OF

INDENT = "  "
Stretch = tuple[int, int]


@dataclass(frozen=True, slots=True)
class _Line:
    """A line without the blanks around it: what it says, its comment, and whether it begins with blanks."""

    code: str
    comment: str
    is_indented: bool

    @property
    def is_blank(self) -> bool:
        return not self.code and not self.comment

    @property
    def first(self) -> str:
        return self.code.partition(" ")[0]

    @property
    def is_fact(self) -> bool:
        return bool(self.code) and self.first not in (*NOUNS, *SETTINGS)

    @property
    def opens(self) -> bool:
        """True if facts may stand below it."""
        return self.first in VERBS_OF

    def __str__(self) -> str:
        return "  ".join(filter(None, (self.code, self.comment)))


def formatted(text: str, start: Start = "line") -> str:
    """The text of a mind, or of a .break file, as it should be written.

    One that cannot be read keeps the words of its bad lines as they are.
    """
    end = "\r\n" if "\r\n" in text else "\n"
    return "".join(f"{line}{end}" for line in _placed([_line(line, start) for line in text.split("\n")], start))


def _line(text: str, start: Start) -> _Line:
    code = without_comment(text)
    return _Line(spaced(code.lstrip(" \t").rstrip(BLANKS), start), text[len(code) :].strip(), text[:1] in (" ", "\t"))


def _placed(lines: list[_Line], start: Start) -> Iterator[str]:
    """The lines indented, with single blank ones: none at the ends or below a header, one around what owns facts.

    A comment goes with what it leads, or else keeps to what it closes.
    """
    above: _Line | None = None
    in_declaration = was_in = blank = False
    for line, following in zip(lines, _next_written(lines), strict=True):
        if line.is_blank:
            blank = True
            continue
        if line.code:
            in_declaration = line.is_fact or line.first in NOUNS
        leads = following is not None and following.is_fact
        is_in = line.is_fact if line.code else leads or (line.is_indented and in_declaration)
        is_in = is_in and start == "line"
        if above and not (above.opens and is_in):
            is_led = not above.code and not was_in  # by a comment
            begins = following is not None and not is_led and (following.opens or was_in)
            if blank or (begins and not is_in):
                yield ""
        yield f"{INDENT if is_in else ''}{line}"
        above, was_in, blank = line, is_in, False


def _next_written(lines: list[_Line]) -> list[_Line | None]:
    """For each line the next that says something, which may be itself."""
    found: list[_Line | None] = []
    following: _Line | None = None
    for line in reversed(lines):
        following = line if line.code else following
        found.append(following)
    return found[::-1]


def spaced(code: str, start: Start = "line") -> str:
    """A line with its words one space apart; as it is where it cannot be read."""
    if not code:
        return ""
    plan = _plan(code if '"' in code else shape_of(code), start)
    if plan is None:
        return code
    parts = pieces(code)
    words = (("".join(parts[first:end]), after) for first, end, after in plan)
    # one of two words, such as `least of`, has one space between
    return "".join((word if word.startswith('"') else " ".join(word.split())) + after for word, after in words)


Plan = tuple[tuple[int, int, str], ...]  # which pieces of a line are a word, and what stands after it


@lru_cache(MAX_SHAPES)
def _plan(shape: str, start: Start) -> Plan | None:
    """The spacing of the words in lines of a shape; None where Lark cannot read it."""
    from lark import UnexpectedInput

    starts = accumulate(map(len, pieces(shape)), initial=0)
    places = {start: number for number, start in enumerate(starts)}
    try:
        return tuple((places[first], places[end], after) for first, end, after in _words(shape, start))
    except UnexpectedInput:
        return None


def _words(code: str, start: Start) -> Iterator[tuple[int, int, str]]:
    """Offsets (start, end) of the words of a line, and the space that belongs after each: none after a sign."""
    from lark import Token

    whole = grammar().parse(code, start=start)
    parts = (tree.children[0] for tree in whole.iter_subtrees() if tree.children)
    signs = {part.start_pos for part in parts if isinstance(part, Token) and part.type in ("SIGN", "MINUS")}
    own = {*signs}  # of one number or one operand
    for numbers in whole.find_data("numbers"):
        inside = [part for part in numbers.scan_values(bool) if isinstance(part, Token)]
        is_list = not any(part.type in ("NAME", "SCALE") for part in inside) and not [*numbers.find_data("nested")]
        signs |= {part.start_pos for part in inside if is_list and part.type == "SPACED"}  # there no sign ever adds
    tokens = list(grammar().parse_interactive(code, start=start).iter_parse())
    for token, following in zip(tokens, [*tokens[1:], None], strict=True):
        first = token.start_pos or 0
        subtracts = first not in own and following is not None and following.start_pos in own  # as in 30 - -15
        glued = following is None or token == "(" or following in (")", "%") or (first in signs and not subtracts)
        yield first, token.end_pos or 0, "" if glued else " "


def format_splices(source: Source, start: Start = "line") -> list[Splice]:
    """The splices that format a text; they touch few lines, so that an editor's cursor and marks stay where they are.

    No line comes or goes but for blank ones, so each that says something is held against the one in its place.
    """
    text = formatted(source.text, start)
    before, after = [*_stretches(source.text)], [*_stretches(text)]
    if len(before) != len(after):
        return [Splice(source, 0, len(source.text), text)]
    pairs = zip(before, after, strict=True)
    return [
        Splice(source, *old, text[slice(*new)]) for old, new in pairs if source.text[slice(*old)] != text[slice(*new)]
    ]


def _stretches(text: str) -> Iterator[Stretch]:
    """Offsets (start, end) that cut up a text: by turns the space between lines, and a line that is not blank."""
    ends, at = [0], 0
    for line in text.split("\n"):
        if line.strip(BLANKS):
            ends += [at, at + len(line)]
        at += len(line) + 1
    return pairwise([*ends, len(text)])
