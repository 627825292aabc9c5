"""A value that is always clamped.

Every influence and command is clamped to 0..1. A value that is only sometimes outside is fine: it is how a rule says
"at most". One that always is says no more than 0 or 1, whatever its skill reads.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Edge, Expression
from mindlang.editing.insertion import instead
from mindlang.lint.intervals import Interval, interval, is_constant, range_in_words
from mindlang.lint.study import Finding, Found, Study

READS = """
sensor eye is range_finder at 0 deg
skill Go is rule
  reads eye
"""
GOOD = (f"{READS}  drives left_wheel at 2 * (1 - eye)\n", f"{READS}  drives left_wheel at 1\n")
BAD = (
    f"{READS}  drives left_wheel at 1 + eye\n",
    f"{READS}  drives left_wheel at -eye\n",
    f"{READS}  drives left_wheel at-eye\n",
    f"{READS}  drives left_wheel at 20\n",
)


def check(study: Study) -> Found:
    """Values outside of 0..1, and those that read something and never get inside."""
    for skill in (each for each in study.mind.skills if not each.like):
        for value in (value for edge in skill.edges if not _is_zero_influence(edge) for value in edge.values):
            found = interval(value)
            is_outside = found[0] > 1 or found[1] < 0
            if is_outside or (not is_constant(value) and (found[0] == 1 or found[1] == 0)):
                yield _finding(value, found)


def _is_zero_influence(edge: Edge) -> bool:
    """Whether this is for edge_at_zero to tell."""
    return edge.to == "skill" and bool(edge.at) and all(interval(value)[1] <= 0 for value in edge.values)


def _finding(value: Expression, found: Interval) -> Finding:
    clamped = 1 if found[0] >= 1 else 0
    fix = Fix(f"Write {clamped}", (instead(value.span, str(clamped)),))
    message = f"This value is {range_in_words(found)}, which is clamped to {clamped}."
    share = f", or {found[0]:g}% if that is meant" if found[0] == found[1] and 1 < found[0] <= 100 else ""
    hint = f"Write {clamped}{share or ', or a value that gets between 0 and 1'}."
    return Finding(value.span, message, hint, fix=fix)
