"""`mindc edit unfold`."""

import re

from mindlang.compiler.families import lies_in, numbered
from mindlang.compiler.parse import without_comment
from mindlang.compiler.source import Splice
from mindlang.compiler.syntax import PARTS
from mindlang.editing.insertion import first_line, newline
from mindlang.editing.project import EditError, MindChange, Project

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
