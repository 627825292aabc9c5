"""A direction that is compared as if it were a number on a line."""

from collections import Counter
from collections.abc import Iterator, Set
from typing import Any

from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.expression import fold

from mindlang.compiler.syntax import Comparison, Term, When
from mindlang.lint.intervals import OPPOSITES, STRICT, TURNED, UPPER
from mindlang.lint.study import Finding, Found, Study, rule


@rule()
def direction_as_number(study: Study) -> Found:
    known = directions(study.sensors)
    for sensor in study.mind.sensors:
        if sensor.kind.compares and sensor.kind.source in known:
            of = sensor.kind.source
            message = f"{of} is a direction: behind the robot it goes from 0 to 1, and {sensor.name} flips there."
            hint = f"Take how far it is off: computed at greatest of {of} (1 - {of}) is 0.5 ahead and 1 behind."
            yield Finding(sensor.span, message, hint)
    decaying = {memory.name for memory in study.mind.memories if memory.kind.mixes}
    for edge in (edge for _, edge in study.edges if edge.to == "memory" and edge.target in decaying):
        memory = edge.target
        for reading in (term for value in edge.values for term in value.found("reading")):
            if (name := reading.operand) in known:
                message = f"{name} is a direction, which {memory} mixes as a number: left and right behind it, 0.5."
                hint = f"Let it hold one, register, or read average of {name} over some ticks."
                yield Finding(reading.span, message, hint)
    for when, *_ in study.conditions:
        yield from _one_sided(when, known)
        yield from _of_two(when, known)


def _of_two(when: When, known: Set[str]) -> Iterator[Finding]:
    """Comparisons of two directions."""
    for each in (each for all_ in when.alternatives for each in all_):
        form, _ = _linear(each)
        if len(form) > 1 and form.keys() <= known:
            one, other = [*form][:2]
            message = f"{one} and {other} are directions: neither is less, and behind the robot both begin anew."
            hint = f"Compare how far they are apart: greatest of ({one} - {other}) ({other} - {one}) is 0 and 1 there."
            yield Finding(_reading(each, one).span, message, hint)


Form = dict[str, float]  # a sum of readings, each times a number; without a name, a number more


def _plus(one: Form, other: Form, times: float) -> Form:
    """The sum of one and so many times the other; a reading that is left 0 times is none of it."""
    found = {name: one.get(name, 0.0) + times * other.get(name, 0.0) for name in (*one, *other)}
    return {name: number for name, number in found.items() if number or not name}


def _linear(each: Comparison) -> tuple[Form, float]:
    """The linear form of left minus right, and its constant; empty where that is no sum of readings times numbers."""

    def leaf(word: str, operand: Any) -> Form | None:
        return {"": operand} if word == "number" else {operand: 1.0} if word == "reading" else None

    def combined(symbol: str, left: Form | None, right: Form | None) -> Form | None:
        if left is None or right is None:
            return None
        match symbol:
            case "+" | "-":
                return _plus(left, right, 1.0 if symbol == "+" else -1.0)
            case "*" if not right.keys() - {""}:
                return _plus({}, left, right.get("", 0.0))
            case "*" if not left.keys() - {""}:
                return _plus({}, right, left.get("", 0.0))
            case "/" if not right.keys() - {""} and right.get(""):
                return _plus({}, left, 1 / right[""])
        return None

    def negated(form: Form | None) -> Form | None:
        return None if form is None else _plus({}, form, -1.0)

    form = fold((*each.left.formula, *each.right.formula, ("-", 0)), leaf, negated, combined) or {}
    return {name: times for name, times in form.items() if name}, form.get("", 0.0)


def _reading(each: Comparison, name: str) -> Term:
    """The first mention of a reading in a comparison."""
    terms = (*each.left.found("reading"), *each.right.found("reading"))
    return next(term for term in terms if term.operand == name)


def _one_sided(when: When, known: Set[str]) -> Iterator[Finding]:
    """The directions of which a condition asks for one side of what is behind and nothing else, or for all but that."""
    sides = [[side for each in all_ if (side := _side(each, known))] for all_ in when.alternatives]
    asked = Counter(reading.operand for all_ in sides for reading, *_ in all_)
    for reading, compare, number in (side for all_ in sides for side in all_):
        if asked[reading.operand] > 1:
            continue
        other = f"{reading.operand} {TURNED[compare]} {1 - number:g}"
        if _is_behind(OPPOSITES[compare], number):
            message = f"{reading.operand} is a direction, and this leaves out what is behind on one side alone."
            yield Finding(reading.span, message, f"Leave out the other side as well: and {other}.")
        elif _is_behind(compare, number):
            is_left = compare in UPPER
            here, there = ("left", "right") if is_left else ("right", "left")
            same = f"{reading.operand} {'>= 0' if is_left else '<= 1'}"
            message = f"{reading.operand} is a direction, and this is behind on the {here} alone, not on the {there}."
            yield Finding(reading.span, message, f"Add or {other}, or, where one side is meant, and {same}.")


def _is_behind(compare: str, number: float) -> bool:
    """True if a direction can compare so to a number, and only behind the robot."""
    off = number if compare in UPPER else 1 - number
    return off <= 0.25 and (off > 0 or (off == 0 and compare not in STRICT))


def _side(each: Comparison, known: Set[str]) -> tuple[Term, str, float] | None:
    """The direction that is compared with a number, how, and the number."""
    form, more = _linear(each)
    if len(form) != 1 or not form.keys() <= known:
        return None
    ((name, times),) = form.items()
    return _reading(each, name), each.compare if times > 0 else TURNED[each.compare], -more / times + 0.0
