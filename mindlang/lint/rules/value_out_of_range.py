"""A value that is always clamped.

Every influence and command is clamped to 0..1. A value that is only sometimes outside is fine: it is how a rule says
"at most". One that always is says no more than 0 or 1, whatever its skill reads.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.editing.insertion import replace_span
from mindlang.lint.examples import READS
from mindlang.lint.intervals import interval, is_constant, range_in_words
from mindlang.lint.study import Finding, Found, Study, is_zero_influence

GOOD = (f"{READS}  drives left_wheel at 2 * (1 - eye)\n", f"{READS}  drives left_wheel at 1\n")
BAD = (
    f"{READS}  drives left_wheel at 1 + eye\n",
    f"{READS}  drives left_wheel at -eye\n",
    f"{READS}  drives left_wheel at 20\n",
)


def check(study: Study) -> Found:
    # an influence that is always 0 is for edge-at-zero to tell
    sent = (
        edge for skill, edge in study.edges if not (is_zero_influence(edge) or (skill.chooses and edge.to == "skill"))
    )
    for value in (value for edge in sent for value in edge.values):
        low, high = interval(value)
        if low > 1 or high < 0 or (not is_constant(value) and (low == 1 or high == 0)):
            clamped = 1 if low >= 1 else 0
            share = f", or {low:g}% if that is meant" if low == high and 1 < low <= 100 else ""
            message = f"This value is {range_in_words((low, high))}, which is clamped to {clamped}."
            hint = f"Write {clamped}{share or ', or a value that gets between 0 and 1'}."
            fix = Fix(f"Write {clamped}", (replace_span(value.span, str(clamped)),))
            yield Finding(value.span, message, hint, fix=fix)
