"""A direction that is compared as if it were a number on a line.

A compass or a bearing goes round: just behind on the left it reads 0, just behind on the right 1. So `when north > 90%`
is behind on the right alone, and a latch of one flips behind, however far apart its thresholds are. Compare with both
sides, or how far it is off: `computed at greatest of north (1 - north)` is 0.5 straight ahead and 1 behind. Of two
directions neither is less, and a memory that decays mixes what it is sent as numbers.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass

from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.expression import fold

from mindlang.compiler.model import Comparison, Expression, Number, Reading, Term, When
from mindlang.lint.intervals import OPPOSITES, STRICT, TURNED, UPPER, words
from mindlang.lint.study import Finding, Found, Study

SENSORS = "sensor north is compass\nsensor off is computed at greatest of north (1 - north)\n"
SKILL = "skill Go is rule\n  reads north\n  drives left_wheel at 1 when"
GOOD = (
    f"{SENSORS}sensor behind is latch of off below 70% above 80%\n",
    f"{SENSORS}{SKILL} north > 90% or north < 10%\n",
    f"{SENSORS}{SKILL} north > 0.5\n",
    f"{SENSORS}{SKILL} north > 90% and north <= 1\n",
    f"{SENSORS}{SKILL} north > 1\n",
    f"{SENSORS}{SKILL} 2 * north > 1\n",
    f"{SENSORS}memory seen is cell decay 0\n{SKILL} north > 0.5\n  drives seen at north\n",
)
BAD = (
    f"{SENSORS}sensor behind is latch of north below 20% above 80%\n",
    f"{SENSORS}sensor calm is average of north over 5 ticks\nsensor behind is latch of calm below 20% above 80%\n",
    f"{SENSORS}{SKILL} north > 90%\n",
    f"{SENSORS}{SKILL} 0.2 > north otherwise 0\n",
    f"{SENSORS}{SKILL} north <= 0.9\n",
    f"{SENSORS}{SKILL} 1 - north < 10%\n",
    f"{SENSORS}{SKILL} 2 * north - 1.8 > 0\n",
    f"{SENSORS}sensor home is compass\n{SKILL} north - home > 0.1\n  reads home\n",
    f"{SENSORS}sensor turned is computed at north + 0.25\nsensor behind is latch of turned below 20% above 80%\n",
    f"{SENSORS}memory seen is cell decay 0.5\n{SKILL} north > 0.5\n  drives seen at north\n",
    "sensor north is compass\ntask Course in arena\n  lasts 9 s\n  rewards 1 per tick when north >= 3/4\n",
)


def check(study: Study) -> Found:
    """Latches of directions, and conditions that hold behind the robot on one side."""
    known = directions(study.sensors)
    for sensor in study.mind.sensors:
        if sensor.kind.compares and sensor.kind.source in known:
            of = sensor.kind.source
            message = f"{of} is a direction: behind the robot it goes from 0 to 1, and {sensor.name} flips there."
            hint = f"Take how far it is off: computed at greatest of {of} (1 - {of}) is 0.5 ahead and 1 behind."
            yield Finding(sensor.span, message, hint)
    decaying = {memory.name for memory in study.mind.memories if memory.kind.decay > 0}
    for edge in (edge for _, edge in study.edges if edge.to == "memory" and edge.target in decaying):
        yield from _mixed(edge.values, edge.target, known)
    for when in (condition.when for condition in study.conditions):
        yield from _one_sided(when, known)
        yield from _of_two(when, known)


def _mixed(values: Sequence[Expression], memory: str, known: Set[str]) -> Iterator[Finding]:
    """Directions that a memory is sent which decays."""
    for reading in (term for value in values for term in value.terms if isinstance(term, Reading)):
        if reading.name in known:
            message = f"{reading.name} is a direction, which {memory} mixes as a number: left and right behind it, 0.5."
            hint = f"Let it hold one, cell decay 0, or read average of {reading.name} over some ticks."
            yield Finding(reading.span, message, hint)


def _of_two(when: When, known: Set[str]) -> Iterator[Finding]:
    """Comparisons of two directions."""
    for each in (each for all_ in when.alternatives for each in all_):
        form = _linear(each.left, each.right)
        if form and len(form.of) > 1 and form.of.keys() <= known:
            one, other = [*form.of][:2]
            message = f"{one} and {other} are directions: neither is less, and behind the robot both begin anew."
            hint = f"Compare how far they are apart: greatest of ({one} - {other}) ({other} - {one}) is 0 and 1 there."
            yield Finding(form.at[one].span, message, hint)


@dataclass(frozen=True, slots=True)
class _Linear:
    """Readings times numbers, and a number more; `at` says where each reading stands first."""

    of: Mapping[str, float]
    more: float
    at: Mapping[str, Reading]

    def plus(self, other: "_Linear", times: float) -> "_Linear":
        """The sum with so many times another."""
        names = dict.fromkeys([*self.of, *other.of])
        of = {name: self.of.get(name, 0.0) + times * other.of.get(name, 0.0) for name in names}
        return _Linear(
            {name: x for name, x in of.items() if x}, self.more + times * other.more, {**other.at, **self.at}
        )

    def times(self, number: float) -> "_Linear":
        """The sum with every reading, and the number more, multiplied by a number."""
        return _Linear({}, 0.0, {}).plus(self, number)


def _linear(left: Expression, right: Expression) -> _Linear | None:
    """What is left less what is right; None where that is no sum of readings times numbers."""
    one, other = _sum(left), _sum(right)
    return one.plus(other, -1.0) if one and other else None


def _sum(of: Expression) -> _Linear | None:
    def leaf(_: str, term: Term) -> _Linear | None:
        match term:
            case Number(value):
                return _Linear({}, value, {})
            case Reading(name):
                return _Linear({name: 1.0}, 0.0, {name: term})
        return None

    def combined(symbol: str, left: _Linear | None, right: _Linear | None) -> _Linear | None:
        match symbol, left, right:
            case "+" | "-", _Linear(), _Linear():
                return left.plus(right, 1.0 if symbol == "+" else -1.0)
            case "*", _Linear(), _Linear() if not right.of:
                return left.times(right.more)
            case "*", _Linear(), _Linear() if not left.of:
                return right.times(left.more)
            case "/", _Linear(), _Linear() if not right.of and right.more:
                return left.times(1 / right.more)
        return None

    def negated(form: _Linear | None) -> _Linear | None:
        return form and form.times(-1.0)

    return fold(words(of), leaf, negated, combined)


def _one_sided(when: When, known: Set[str]) -> Iterator[Finding]:
    """The directions of which a condition asks for one side of what is behind and nothing else, or for all but that."""
    sides = [[side for each in all_ if (side := _side(each, known))] for all_ in when.alternatives]
    asked = Counter(reading.name for all_ in sides for reading, *_ in all_)
    for reading, compare, number in (side for all_ in sides for side in all_):
        if asked[reading.name] > 1:
            continue
        other = f"{reading.name} {TURNED[compare]} {1 - number:g}"
        if _is_behind(OPPOSITES[compare], number):
            message = f"{reading.name} is a direction, and this leaves out what is behind on one side alone."
            yield Finding(reading.span, message, f"Leave out the other side as well: and {other}.")
        elif _is_behind(compare, number):
            is_left = compare in UPPER
            here, there = ("left", "right") if is_left else ("right", "left")
            same = f"{reading.name} {'>= 0' if is_left else '<= 1'}"
            message = f"{reading.name} is a direction, and this is behind on the {here} alone, not on the {there}."
            yield Finding(reading.span, message, f"Add or {other}, or, where one side is meant, and {same}.")


def _is_behind(compare: str, number: float) -> bool:
    """Whether a direction can be so to a number, and only behind the robot."""
    off = number if compare in UPPER else 1 - number
    return off <= 0.25 and (off > 0 or (off == 0 and compare not in STRICT))


def _side(each: Comparison, known: Set[str]) -> tuple[Reading, str, float] | None:
    """The direction that is compared with a number, how, and the number."""
    form = _linear(each.left, each.right)
    if form is None or len(form.of) != 1 or not form.of.keys() <= known:
        return None
    ((name, times),) = form.of.items()
    return form.at[name], each.compare if times > 0 else TURNED[each.compare], -form.more / times + 0.0
