"""A division by what can be 0.

Every reading, command and memory can be 0, and what is divided by 0 is no number: a reward that is none takes the whole
run out of a training, a sensor that is none makes its skills send nothing, a command that is none is not sent. One tick
is enough, in which a range finder touches something. A number that is added below keeps it away from 0, and so does a
condition, `1 / ahead per tick when ahead > 0.05`; that is looked at for readings and numbers alone.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import inf, nextafter

from msgspec.structs import replace

from mindlang.compiler.model import Comparison, Expression, Reading, When
from mindlang.lint.conditions import OPPOSITES, TURNED, UPPER
from mindlang.lint.intervals import UNIT_INTERVAL, Interval, divisors, formula_divisors, interval, is_constant
from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.worlds import AnalysedWorld, any_world, world

READS = """
sensor eye is range_finder at 0 deg
skill Go is rule
  reads eye
"""
COURSE = "sensor eye is range_finder at 0 deg\ntask Course in arena\n  lasts 9 s\n"
RATIO = "sensor near is range_finder at 0 deg\nsensor far is range_finder at 90 deg\n"
GOOD = (
    f"{READS}  drives left_wheel at 0.1 / (eye + 0.1)\n",
    f"{READS}  drives left_wheel at 0.1 / eye when eye > 0 otherwise 1\n",
    f"{READS}  drives left_wheel at 1 when eye < 0.1 otherwise 0.1 / eye\n",
    f"{COURSE}  ends when eye > 10% and 0.01 / eye > 9%\n",
    f"{COURSE}  rewards 1 / eye per tick when eye >= 5%\n",
    f"{COURSE}  rewards eye / 2 per tick\n",
    f"{RATIO}sensor ratio is computed at near / (near + far + 0.01)\n",
)
BAD = (
    f"{READS}  drives left_wheel at 0.1 / eye\n",
    f"{READS}  drives left_wheel at 1 when eye > 0.5 otherwise 0.1 / eye\n",
    f"{COURSE}  rewards 1 / eye per tick\n",
    f"{COURSE}  rewards 1 / eye per tick when eye >= 0\n",
    f"{COURSE}  ends when 1 / eye > 9\n",
    f"{RATIO}sensor ratio is computed at near / (near + far)\n",
)
MESSAGE = "What is divided by here can be 0, and then this is not a number."
HINT = "Add a little to it, as in 1 / (ahead + 0.01), or say when: 1 / ahead per tick when ahead > 0.01."


def check(study: Study) -> Found:
    """Divisions in sensors, in what skills send, and in rewards and ends."""
    place = any_world(study)
    for part in study.mind.sensors:
        if _has_zero(formula_divisors(part.kind.formula, place.reading) if part.kind.formula else ()):
            yield Finding(part.span, MESSAGE, HINT)
    for each in [*_of_skills(study, place), *_of_tasks(study)]:
        yield Finding(each.span, MESSAGE, HINT)


def _of_skills(study: Study, place: AnalysedWorld) -> Iterator[Expression]:
    for edge in (edge for skill in study.mind.skills if not skill.like for edge in skill.edges):
        when = edge.gate.when if edge.gate else None
        if edge.at and _divides_by_zero(edge.at, place, when):
            yield edge.at
        if (
            edge.gate
            and edge.gate.otherwise
            and _divides_by_zero(edge.gate.otherwise, place, _opposite(edge.gate.when))
        ):
            yield edge.gate.otherwise
        yield from _of_condition(when, place)


def _of_tasks(study: Study) -> Iterator[Expression]:
    for task in study.mind.tasks:
        place = world(study, task)
        for reward in task.rewards:
            each = place.each(reward)
            if _divides_by_zero(reward.amount, place, reward.when, each):
                yield reward.amount
            yield from _of_condition(reward.when, place, each)
        for end in task.ends:
            yield from _of_condition(end.when, place)


def _of_condition(when: When | None, place: AnalysedWorld, each: Interval = UNIT_INTERVAL) -> Iterator[Expression]:
    """What a condition compares that can be a division by 0 while the comparisons beside it hold."""
    if when is None:
        return
    for all_ in when.alternatives:
        for comparison in all_:
            beside = replace(when, alternatives=(tuple(other for other in all_ if other is not comparison),))
            sides = (comparison.left, comparison.right)
            yield from (side for side in sides if _divides_by_zero(side, place, beside, each))


def _opposite(when: When) -> When | None:
    """What holds where a condition of one comparison does not; None of others, of which that is not one `and`."""
    match when.alternatives:
        case ((only,),):
            return replace(when, alternatives=((replace(only, compare=OPPOSITES[only.compare]),),))
    return None


def _divides_by_zero(
    of: Expression, place: AnalysedWorld, when: When | None = None, each: Interval = UNIT_INTERVAL
) -> bool:
    """Whether something in it is divided by what can be 0 while a condition holds."""
    for all_ in when.alternatives if when else ((),):
        ranges = _narrowed(place, all_)
        can_hold = all(low <= high for low, high in ranges.values())
        if can_hold and _has_zero(divisors(of, partial(_reading, place, ranges), each)):
            return True
    return False


def _has_zero(found: Iterable[Interval]) -> bool:
    return any(low <= 0 <= high for low, high in found)


def _reading(place: AnalysedWorld, ranges: Mapping[str, Interval], name: str) -> Interval:
    return ranges.get(name, place.reading(name))


def _narrowed(place: AnalysedWorld, all_: Sequence[Comparison]) -> dict[str, Interval]:
    """The ranges of readings of which these comparisons say something by a number, while all of them hold.

    Where they never do, one ends before it begins.
    """
    found: dict[str, Interval] = {}
    for comparison in all_:
        for side, number, compare in (
            (comparison.left, comparison.right, comparison.compare),
            (comparison.right, comparison.left, TURNED[comparison.compare]),
        ):
            match side.terms:
                case (Reading(name),) if is_constant(number):
                    found[name] = _within(found.get(name, place.reading(name)), compare, interval(number)[0])
    return found


def _within(of: Interval, compare: str, number: float) -> Interval:
    """The part of a range that is so to a number."""
    if compare in UPPER:
        return of[0], min(of[1], nextafter(number, -inf) if compare == "<" else number)
    return max(of[0], nextafter(number, inf) if compare == ">" else number), of[1]
