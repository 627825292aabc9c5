"""A condition that holds always, or of what is read or sent, never.

Every reading, command and memory is between 0 and 1, so `when eye > 20` and `when eye < 20%` and `and eye > 80%` are
never true, `when eye > -1` always is. The line says the same without its condition, or without what only that lets by;
most often the number lacks a % or stands on the wrong side. A reward that is never paid is for `dead-reward`, an end
that never comes for `dead-event`.
"""

from mindlang.compiler.model import Edge, End, Part, Promise
from mindlang.lint.examples import COURSE, EYE, READS
from mindlang.lint.intervals import why_always, why_never
from mindlang.lint.study import Finding, Found, Study

BEGIN = EYE + COURSE
GOOD = (
    f"{READS}  drives left_wheel at 1 when eye > 0.2 and eye < 0.8 otherwise 0.5\n",
    f"{BEGIN}  rewards 1 per tick when eye > 0.5\n  ends when eye <= 0\n",
)
BAD = (
    f"{READS}  drives left_wheel at 1 when eye > 20\n",
    f"{READS}  drives left_wheel at 1 when eye < 20% and eye > 80% otherwise 0.5\n",
    f"{EYE}sensor near is computed at 1 - eye when eye < 20 otherwise 0\n",
    f"{READS}  maintains eye > 20\n  drives left_wheel at 1\n",
    f"{BEGIN}  rewards 1 per tick when eye < 2\n",
    f"{BEGIN}  ends when eye < 20 or eye > 80\n",
)
REMEDY = "Compare with something that is sometimes reached, or leave the condition out."
AT_ONCE = "A run would end with its first tick: compare with something that is sometimes reached."


def check(study: Study) -> Found:
    for when, of, world in study.conditions:
        if isinstance(of, Edge | Part | Promise) and (never := why_never(when, world.range_in(of))):
            yield Finding(when.span, f"This condition never holds: {never}.", REMEDY)
        elif always := why_always(when, world.range_in(of)):
            hint = AT_ONCE if isinstance(of, End) else REMEDY
            yield Finding(when.span, f"This condition always holds: {always}.", hint)
