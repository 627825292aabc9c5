"""The one way in which a `.break` file is written: spaces and blank lines are set, nothing else is touched."""

from itertools import pairwise

from mindlang.breakpoints.parse import grammar, parse_line
from mindlang.compiler.format import tight, words
from mindlang.compiler.parse import BLANKS, code_of
from mindlang.compiler.source import Source


def formatted(text: str) -> str:
    """The text as it should be written; one that cannot be read keeps the words of its bad lines as they are."""
    lines = [_line(line) for line in text.split("\n")]
    end = "\r\n" if "\r\n" in text else "\n"
    single = [line for above, line in pairwise(["", *lines]) if line or above]
    return "".join(f"{line}{end}" for line in single[: len(single) - (single[-1:] == [""])])


def _line(text: str) -> str:
    """A line with its words one space apart, and its comment two spaces after them."""
    code = code_of(text)
    return "  ".join(filter(None, (spaced(code.strip(BLANKS)), text[len(code) :].strip())))


def spaced(code: str) -> str:
    """A line without comment with its words one space apart; as it is where it cannot be read."""
    from lark import UnexpectedInput

    try:
        line = parse_line(code, Source("line", code), 0)
    except UnexpectedInput:
        return code
    return "".join(tight(code[start:end]) + after for start, end, after in words(code, line, grammar()))
