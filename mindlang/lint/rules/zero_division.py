"""A division by what can be 0."""

from collections.abc import Iterator, Sequence
from math import inf, nextafter

from mindrun.numbers.intervals import Interval
from msgspec.structs import replace

from mindlang.compiler.syntax import Comparison, Expression, Term, When
from mindlang.lint.intervals import OPPOSITES, UPPER, bounds, divisors
from mindlang.lint.study import AnalysedWorld, Conditional, Finding, Found, Study, rule

MESSAGE = "What is divided by here can be 0, and then this is not a number."
Alternatives = tuple[tuple[Comparison, ...], ...]
ALWAYS: Alternatives = ((),)  # nothing has to hold
HINT = "Add a little to it, as in 1 / (ahead + 0.01), or say when: 1 / ahead per tick when ahead > 0.01."


@rule()
def zero_division(study: Study) -> Found:
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
    return can_hold and any(low <= 0 <= high for low, high in divisors(value, reading, world.each(of)))


def _within(of: Interval, compare: str, number: float) -> Interval:
    """The part of a range that is so to a number."""
    if compare in UPPER:
        return of[0], min(of[1], nextafter(number, -inf) if compare == "<" else number)
    return max(of[0], nextafter(number, inf) if compare == ">" else number), of[1]
