"""A division by what can be 0.

Every reading, command and memory can be 0, and what is divided by 0 is no number: a reward that is none takes the whole
run out of a training, a sensor that is none makes its skills send nothing, a command that is none is not sent. One tick
is enough, in which a range finder touches something. A number that is added below keeps it away from 0, and so does a
condition, `1 / ahead per tick when ahead > 0.05`; that is looked at for readings and numbers alone.
"""

from collections.abc import Iterator, Sequence
from math import inf, nextafter

from mindrun.numbers.intervals import Interval
from msgspec.structs import replace

from mindlang.compiler.syntax import Comparison, Expression, Term, When
from mindlang.lint.examples import COURSE, EYE, READS
from mindlang.lint.intervals import OPPOSITES, UPPER, bounds, divisors
from mindlang.lint.study import AnalysedWorld, Conditional, Finding, Found, Study

BEGIN = EYE + COURSE
RATIO = "sensor near is range_finder at 0 deg\nsensor far is range_finder at 90 deg\n"
GOOD = (
    f"{READS}  drives left_wheel at 0.1 / (eye + 0.1)\n",
    f"{READS}  drives left_wheel at 0.1 / eye when eye > 0 otherwise 1\n",
    f"{READS}  drives left_wheel at 1 when eye < 0.1 otherwise 0.1 / eye\n",
    f"{BEGIN}  ends when eye > 10% and 0.01 / eye > 9%\n",
    f"{BEGIN}  rewards 1 / eye per tick when eye >= 5%\n",
    f"{RATIO}sensor ratio is computed at near / (near + far + 0.01)\n",
    f"{RATIO}sensor ratio is computed at near / far when far > 0.1 otherwise 0\n",
)
BAD = (
    f"{READS}  drives left_wheel at 0.1 / eye\n",
    f"{READS}  drives left_wheel at 1 when eye > 0.5 otherwise 0.1 / eye\n",
    f"{BEGIN}  rewards 1 / eye per tick\n",
    f"{RATIO}sensor ratio is computed at near / (near + far)\n",
)
MESSAGE = "What is divided by here can be 0, and then this is not a number."
Alternatives = tuple[tuple[Comparison, ...], ...]
ALWAYS: Alternatives = ((),)  # nothing has to hold
HINT = "Add a little to it, as in 1 / (ahead + 0.01), or say when: 1 / ahead per tick when ahead > 0.01."


def check(study: Study) -> Found:
    for value, alternatives, of, world in _values(study):
        if any(_divides_by_zero(value, all_, of, world) for all_ in alternatives):
            yield Finding(value.span, MESSAGE, HINT)


def _values(study: Study) -> Iterator[tuple[Expression, Alternatives, Conditional, AnalysedWorld]]:
    """The expressions of sensors, edges, rewards and comparisons, each with the alternatives in which it counts."""
    for sent in study.computed:
        if sent.at:
            yield sent.at, sent.gate.when.alternatives if sent.gate else ALWAYS, sent, study.any_world
        if sent.gate and sent.gate.otherwise:
            yield sent.gate.otherwise, _opposite(sent.gate.when), sent, study.any_world
    for task in study.mind.tasks:
        for reward in task.rewards:
            alternatives = reward.when.alternatives if reward.when else ALWAYS
            yield reward.amount, alternatives, reward, study.worlds[task.name]
    for when, of, world in study.conditions:
        for all_, comparison in ((each, one) for each in when.alternatives for one in each):
            beside = tuple(other for other in all_ if other is not comparison)
            yield comparison.left, (beside,), of, world
            yield comparison.right, (beside,), of, world


def _opposite(when: When) -> Alternatives:
    """The negation of a condition of one comparison; of others, whose negation is not one `and`, nothing is known."""
    match when.alternatives:
        case ((only,),):
            return ((replace(only, compare=OPPOSITES[only.compare]),),)
    return ALWAYS


def _divides_by_zero(value: Expression, all_: Sequence[Comparison], of: Conditional, world: AnalysedWorld) -> bool:
    """True if a divisor in the expression can be 0 while these comparisons hold."""
    ranges: dict[str, Interval] = {}  # while the comparisons hold; where they never do, one ends before it begins
    for side, compare, number in bounds(all_):
        match side.terms:
            case (Term("reading", name),):
                ranges[name] = _within(ranges.get(name, world.reading(name)), compare, number)

    def reading(name: str) -> Interval:
        return ranges.get(name, world.reading(name))

    can_hold = all(low <= high for low, high in ranges.values())
    return can_hold and _has_zero(divisors(value, reading, world.each(of)))


def _has_zero(found: Sequence[Interval]) -> bool:
    return any(low <= 0 <= high for low, high in found)


def _within(of: Interval, compare: str, number: float) -> Interval:
    """The part of a range that is so to a number."""
    if compare in UPPER:
        return of[0], min(of[1], nextafter(number, -inf) if compare == "<" else number)
    return max(of[0], nextafter(number, inf) if compare == ">" else number), of[1]
