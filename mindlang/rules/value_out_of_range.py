"""A value that is always clamped.

Every influence and command is clamped to 0..1. A value that is only sometimes outside is fine: it is how a rule says
"at most". One that always is says no more than 0 or 1, whatever its skill reads.
"""

from mindlang.analysis.intervals import Interval, interval, is_constant, range_in_words
from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Edge
from mindlang.editing.insertion import instead

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
        for edge in skill.edges:
            if edge.at and not _is_zero_influence(edge, found := interval(edge.at)):
                is_outside = found[0] > 1 or found[1] < 0
                if is_outside or (not is_constant(edge.at) and (found[0] == 1 or found[1] == 0)):
                    yield _finding(edge, found)


def _is_zero_influence(edge: Edge, found: Interval) -> bool:
    """Whether this is for edge_at_zero to tell."""
    return edge.to == "skill" and found[1] <= 0


def _finding(edge: Edge, found: Interval) -> Finding:
    assert edge.at
    clamped = 1 if found[0] >= 1 else 0
    fix = Fix(f"Write {clamped}", (instead(edge.at.span, str(clamped)),))
    message = f"This value is {range_in_words(found)}, which is clamped to {clamped}."
    share = f", or {found[0]:g}% if that is meant" if found[0] == found[1] and 1 < found[0] <= 100 else ""
    hint = f"Write at {clamped}{share or ', or a value that gets between 0 and 1'}."
    return Finding(edge.at.span, message, hint, fix=fix)
