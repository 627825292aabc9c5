"""Names → plain names: scenes, likeness, numbers and rates written out, so that each declaration says all that it is.

Whatever is written out keeps the place where it was said, so that a mistake in it is reported there.
"""

from collections.abc import Mapping
from dataclasses import replace

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.expand.amounts import in_place, written_out
from mindlang.compiler.expand.likeness import refuse_unlike, scenes, tasks
from mindlang.compiler.expand.numbers import numbers
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Amount

__all__ = ["expand", "in_place", "numbers"]


def expand(names: Names, values: Mapping[str, Amount], tick_seconds: float, findings: Findings) -> Names:
    """The declarations with nothing left in them that stands for something else.

    `values` are what the names of numbers stand for.
    """
    plain = {
        noun: {name: written_out(each, values, tick_seconds) for name, each in declarations.items()}
        for noun, declarations in names.table.items()
    }
    written = replace(names, table=plain)
    refuse_unlike(written, findings)
    known = scenes(written, findings)
    whole = {"scene": known, "task": tasks(written, known, findings)}
    return replace(names, table=plain | {noun: each for noun, each in whole.items() if each})
