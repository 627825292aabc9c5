"""Values, conditions and events that are the same whatever is read, and values that can be no numbers.

A direction is no number on a line either: behind the robot it goes from 0 to 1.
"""

from collections import Counter
from collections.abc import Iterator, Sequence, Set
from math import inf, nextafter
from typing import Any

from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.expression import fold
from mindrun.numbers.intervals import Interval
from msgspec.structs import replace

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Edge, End, Part, Promise
from mindlang.compiler.syntax import Comparison, Contains, Counts, Expression, Term, When, of_form
from mindlang.editing.insertion import replace_span
from mindlang.lint import intervals
from mindlang.lint.study import (
    AnalysedWorld,
    Conditional,
    Finding,
    Found,
    Study,
    is_zero_influence,
    removal,
    rule,
    saying,
)

REMEDY = "Compare with something that is sometimes reached, or leave the condition out."
AT_ONCE = "A run would end with its first tick: compare with something that is sometimes reached."


@rule()
def constant_condition(study: Study) -> Found:
    for when, of, world in study.conditions:
        if isinstance(of, Edge | Part | Promise) and (never := intervals.why_never(when, world.range_in(of))):
            yield Finding(when.span, f"This condition never holds: {never}.", REMEDY)
        elif always := intervals.why_always(when, world.range_in(of)):
            hint = AT_ONCE if isinstance(of, End) else REMEDY
            yield Finding(when.span, f"This condition always holds: {always}.", hint)


@rule()
def constant_sensor(study: Study) -> Found:
    for part in study.mind.sensors:
        constant = study.any_world.constant(part.name)
        if constant is not None:
            yield Finding(part.span, f"{part.name} always reads {constant:g}.", f"{part.kind.remedy}, or take it out.")


@rule()
def value_out_of_range(study: Study) -> Found:
    # an influence that is always 0 is for edge-at-zero to tell
    sent = (
        edge for skill, edge in study.edges if not (is_zero_influence(edge) or (skill.chooses and edge.to == "skill"))
    )
    for value in (value for edge in sent for value in edge.values):
        low, high = intervals.interval(value)
        if low > 1 or high < 0 or (not intervals.is_constant(value) and (low == 1 or high == 0)):
            clamped = 1 if low >= 1 else 0
            share = f", or {low:g}% if that is meant" if low == high and 1 < low <= 100 else ""
            message = f"This value is {intervals.range_in_words((low, high))}, which is clamped to {clamped}."
            hint = f"Write {clamped}{share or ', or a value that gets between 0 and 1'}."
            fix = Fix(f"Write {clamped}", (replace_span(value.span, str(clamped)),))
            yield Finding(value.span, message, hint, fix=fix)


@rule()
def edge_at_zero(study: Study) -> Found:
    for skill, edge in study.edges:
        if edge.at and is_zero_influence(edge) and not skill.chooses:
            message = f"{skill.name} never has influence on {edge.target}: this is always 0."
            hint = "Give it a value above 0, or take the line out."
            yield Finding(edge.at.span, message, hint, fix=removal(edge.fact) if len(skill.edges) > 1 else None)


@rule()
def dead_event(study: Study) -> Found:
    for task in study.mind.tasks:
        world = study.worlds[task.name]
        counted = zip(of_form(task.facts, Counts), task.counts, strict=True)
        for fact, event in (*((end.fact, end.event) for end in task.ends), *counted):
            if fact.event and event and (why := event.hindrance(world)):
                yield Finding(fact.event.span, f"This never happens: {why[0]}.", why[1], fix=removal(fact))
        for end in task.ends:
            if end.when and (never := intervals.why_never(end.when, world.range_in(end))):
                hint = "Compare with something that is reached, or take the line out."
                yield Finding(end.when.span, f"This never happens: {never}.", hint, fix=removal(end.fact))


@rule()
def dead_reward(study: Study) -> Found:
    for task in study.mind.tasks:
        for reward in task.rewards:
            if why := study.worlds[task.name].why_never_paid(reward):
                span, message, hint = why
                fix = removal(reward.fact, "Remove the reward")
                yield Finding(span, f"This reward is never paid: {message}.", hint, fix=fix)


REACHED = "reached"  # the argument that is left out


@rule(once_a_line=True)
def unsaid_outcome(study: Study) -> Found:
    for task in study.mind.tasks:
        events = [*task.counts, *(reward.on for reward in task.rewards if reward.on)]
        ending = {end.event for end in task.ends if end.times == 1 and not end.opens}
        reached = {event.thing for event in events if event.outcome == REACHED and event not in ending}
        for name, phrase in ((fact.name, fact.phrase) for fact in of_form(task.facts, Contains)):
            if name.text in reached and all(argument.key.text != REACHED for argument in phrase.arguments):
                hint = "Write reached stays, or reached moves to have it appear elsewhere as it once did."
                fix = saying([phrase], "reached moves")
                yield Finding(name.span, f"{name.text} stays where it is when it is reached.", hint, fix=fix)


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
            return ((replace(only, compare=intervals.OPPOSITES[only.compare]),),)
    return ALWAYS


def _divides_by_zero(value: Expression, all_: Sequence[Comparison], of: Conditional, world: AnalysedWorld) -> bool:
    """True if a divisor in the expression can be 0 while these comparisons hold."""
    ranges: dict[str, Interval] = {}  # while the comparisons hold; where they never do, one ends before it begins
    for side, compare, number in intervals.bounds(all_):
        match side.terms:
            case (Term("reading", name),):
                ranges[name] = _within(ranges.get(name, world.reading(name)), compare, number)

    def reading(name: str) -> Interval:
        return ranges.get(name, world.reading(name))

    can_hold = all(low <= high for low, high in ranges.values())
    return can_hold and any(low <= 0 <= high for low, high in intervals.divisors(value, reading, world.each(of)))


def _within(of: Interval, compare: str, number: float) -> Interval:
    """The part of a range that is so to a number."""
    if compare in intervals.UPPER:
        return of[0], min(of[1], nextafter(number, -inf) if compare == "<" else number)
    return max(of[0], nextafter(number, inf) if compare == ">" else number), of[1]


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
        other = f"{reading.operand} {intervals.TURNED[compare]} {1 - number:g}"
        if _is_behind(intervals.OPPOSITES[compare], number):
            message = f"{reading.operand} is a direction, and this leaves out what is behind on one side alone."
            yield Finding(reading.span, message, f"Leave out the other side as well: and {other}.")
        elif _is_behind(compare, number):
            is_left = compare in intervals.UPPER
            here, there = ("left", "right") if is_left else ("right", "left")
            same = f"{reading.operand} {'>= 0' if is_left else '<= 1'}"
            message = f"{reading.operand} is a direction, and this is behind on the {here} alone, not on the {there}."
            yield Finding(reading.span, message, f"Add or {other}, or, where one side is meant, and {same}.")


def _is_behind(compare: str, number: float) -> bool:
    """True if a direction can compare so to a number, and only behind the robot."""
    off = number if compare in intervals.UPPER else 1 - number
    return off <= 0.25 and (off > 0 or (off == 0 and compare not in intervals.STRICT))


def _side(each: Comparison, known: Set[str]) -> tuple[Term, str, float] | None:
    """The direction that is compared with a number, how, and the number."""
    form, more = _linear(each)
    if len(form) != 1 or not form.keys() <= known:
        return None
    ((name, times),) = form.items()
    return _reading(each, name), each.compare if times > 0 else intervals.TURNED[each.compare], -more / times + 0.0
