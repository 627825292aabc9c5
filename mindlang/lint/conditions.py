"""Whether a condition can ever hold, and whether it always does, by the ranges of what it compares."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mindlang.compiler.model import Comparison, Expression, When
from mindlang.lint.intervals import Interval, is_constant, range_in_words

Range = Callable[[Expression], Interval]  # in which the value of an expression lies

COMPARISON_WORDS = {"<": "below", "<=": "at or below", ">": "above", ">=": "at or above"}
OPPOSITES = {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}
TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}  # the same with its sides the other way round
UPPER = ("<", "<=")
STRICT = ("<", ">")


@dataclass(frozen=True, slots=True)
class _Bound:
    """`subject compare number`."""

    subject: str
    compare: str
    number: float

    @property
    def words(self) -> str:
        return f"{COMPARISON_WORDS[self.compare]} {self.number:g}"


def why_never(when: When, value: Range) -> str | None:
    """Why a condition never holds: what is wrong with the first of its alternatives; None where one may hold."""
    reasons = [_why_never(all_, value) for all_ in when.alternatives]
    return reasons[0] if all(reasons) else None


def why_always(when: When, value: Range) -> str | None:
    """Why a condition holds whatever is read; None where it may not."""
    for all_ in when.alternatives:
        if not any(_can_be(each, OPPOSITES[each.compare], value) for each in all_):
            return _in_words(all_[0], "always", value)
    return None


def _why_never(all_: Sequence[Comparison], value: Range) -> str | None:
    """Why comparisons never hold all at once."""
    never = next((each for each in all_ if not _can_be(each, each.compare, value)), None)
    return _in_words(never, "never", value) if never else _contradiction(all_, value)


def _can_be(each: Comparison, compare: str, value: Range) -> bool:
    """Whether both sides of a comparison can be to each other as `compare` says."""
    left, right = value(each.left), value(each.right)
    match compare:
        case "<":
            return left[0] < right[1]
        case "<=":
            return left[0] <= right[1]
        case ">":
            return left[1] > right[0]
    return left[1] >= right[0]


def _in_words(each: Comparison, how_often: str, value: Range) -> str:
    left, right = (range_in_words(value(side)) for side in (each.left, each.right))
    compared = f"{COMPARISON_WORDS[each.compare]} {right.removeprefix('always ')}"
    return f"{each.left.span.text} is {left}, {how_often} {compared}"


def _contradiction(all_: Sequence[Comparison], value: Range) -> str | None:
    """What would have to be below a number and above a greater one."""
    bounds: dict[str, list[_Bound]] = {}
    for bound in filter(None, (_bound(each, value) for each in all_)):
        bounds.setdefault(bound.subject, []).append(bound)
    for subject, found in bounds.items():
        upper = min((each for each in found if each.compare in UPPER), key=_strictest, default=None)
        lower = max((each for each in found if each.compare not in UPPER), key=_strictest, default=None)
        if upper and lower and not _both_hold(lower, upper):
            return f"{subject} is never {upper.words} and {lower.words} at once"
    return None


def _bound(each: Comparison, value: Range) -> _Bound | None:
    """What a comparison with a number says of its other side."""
    if is_constant(each.right):
        return _Bound(" ".join(each.left.span.text.split()), each.compare, value(each.right)[0])
    if is_constant(each.left):
        return _Bound(" ".join(each.right.span.text.split()), TURNED[each.compare], value(each.left)[0])
    return None


def _strictest(bound: _Bound) -> tuple[float, bool]:
    """The order of upper bounds, of which the least is the strictest, and of lower ones, where it is the greatest."""
    return bound.number, (bound.compare in STRICT) != (bound.compare in UPPER)


def _both_hold(lower: _Bound, upper: _Bound) -> bool:
    is_open = lower.compare in STRICT or upper.compare in STRICT
    return lower.number < upper.number or (lower.number == upper.number and not is_open)
