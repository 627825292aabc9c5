"""The comment right above a declaration: what its author says of it."""

from itertools import takewhile

from mindlang.compiler.syntax import Declaration
from mindlang.editing.lines import first_line


def leading(declaration: Declaration) -> str:
    """The comments right above a declaration as one paragraph, and the one at the end of its line."""
    line = first_line(declaration.header.span)
    above = [each.text for each in takewhile(lambda each: each.is_comment, line.above())]
    behind = declaration.header.span.source.text[declaration.header.span.end : line.end]
    return " ".join(text.strip().lstrip("# ") for text in [*reversed(above), behind]).strip()
